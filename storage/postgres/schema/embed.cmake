# cmake -DOUTPUT=postgres_sql.cc -DSTEPS=a.sql;b.sql -P embed.cmake: the .sql files as C++ string literals.
set(literals "")
foreach(step ${STEPS})
  file(READ ${step} sql)
  string(APPEND literals "    R\"sql(${sql})sql\",\n")
endforeach()
file(WRITE ${OUTPUT} "// Made from storage/postgres/schema/*.sql by embed.cmake.
#include \"storage/postgres/schema.h\"

namespace dhpmap::postgres {
namespace {
constexpr const char* kTexts[] = {
${literals}};
}  // namespace
std::span<const char* const> SchemaTexts() { return kTexts; }
}  // namespace dhpmap::postgres
")
