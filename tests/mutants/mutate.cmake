# cmake -DFILE=... -DNAME=... -DFROM=... -DTO=... -P mutate.cmake: FROM, an expression that must stand in the file exactly
# once, becomes TO wherever the fault NAME is switched on.
file(READ "${FILE}" text)
string(REPLACE "${FROM}" "" without "${text}")
string(LENGTH "${text}" before)
string(LENGTH "${without}" after)
string(LENGTH "${FROM}" length)
math(EXPR removed "${before} - ${after}")
if(NOT removed EQUAL length)
  message(FATAL_ERROR "${FILE}: \"${FROM}\" does not occur exactly once; tests/mutants/CMakeLists.txt must follow the code")
endif()
string(REPLACE "${FROM}" "(::norrsken::mutants::${NAME} ? (${TO}) : (${FROM}))" text "${text}")
file(WRITE "${FILE}" "${text}")
