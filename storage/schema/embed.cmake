# cmake -DOUTPUT=schema_sql.cc -DSTEPS=a.sql;b.sql -P embed.cmake: the .sql files as C++ string literals.
set(literals "")
foreach(step ${STEPS})
  file(READ ${step} sql)
  string(APPEND literals "    R\"sql(${sql})sql\",\n")
endforeach()
file(WRITE ${OUTPUT} "// Made from storage/schema/*.sql by embed.cmake.
#include \"storage/schema/steps.h\"

namespace dhpmap {
namespace {
constexpr const char* kSql[] = {
${literals}};
}  // namespace
std::span<const char* const> SchemaSql() { return kSql; }
}  // namespace dhpmap
")
