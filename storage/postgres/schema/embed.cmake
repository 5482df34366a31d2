# cmake -DOUTPUT=postgres_sql.cc -DSTEPS=0001_a.sql;0002_b.sql -P embed.cmake: the .sql files as C++ string literals, each
# with the number that its name begins with.
set(literals "")
foreach(step ${STEPS})
  file(READ ${step} sql)
  get_filename_component(name ${step} NAME)
  string(REGEX MATCH "^[0-9][0-9][0-9][0-9]" digits ${name})
  math(EXPR number "1${digits} - 10000")
  string(APPEND literals "    {${number}, R\"sql(${sql})sql\"},\n")
endforeach()
file(WRITE ${OUTPUT} "// Made from storage/postgres/schema/*.sql by embed.cmake.
#include \"storage/postgres/schema.h\"

namespace dhpmap::postgres {
std::vector<SchemaStep> ReleasedSteps() {
  return {
${literals}};
}
}  // namespace dhpmap::postgres
")
