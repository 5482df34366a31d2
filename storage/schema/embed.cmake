# cmake -DOUTPUT=schema_steps.cc -DSTEPS=a.sql;b.sql -P embed.cmake: the .sql files as C++ string literals.
set(literals "")
foreach(step ${STEPS})
  file(READ ${step} sql)
  string(APPEND literals "    R\"sql(${sql})sql\",\n")
endforeach()
file(WRITE ${OUTPUT} "// Made from storage/schema/*.sql by embed.cmake.
#include \"storage/schema/migrate.h\"

namespace dhpmap {
namespace {
constexpr const char* kSteps[] = {
${literals}};
}  // namespace
std::span<const char* const> SchemaSteps() { return kSteps; }
}  // namespace dhpmap
")
