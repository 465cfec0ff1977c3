# cmake -DINPUT=... -DOUTPUT=... -DFROM=... -DTO=... -P mutate.cmake: copies a file with one replacement, which must
# apply exactly once.
file(READ "${INPUT}" text)
string(REPLACE "${FROM}" "" without "${text}")
string(LENGTH "${text}" before)
string(LENGTH "${without}" after)
string(LENGTH "${FROM}" length)
math(EXPR removed "${before} - ${after}")
if(NOT removed EQUAL length)
  message(FATAL_ERROR "${INPUT}: \"${FROM}\" does not occur exactly once; tests/mutants/CMakeLists.txt must follow the code")
endif()
string(REPLACE "${FROM}" "${TO}" text "${text}")
file(WRITE "${OUTPUT}" "${text}")
