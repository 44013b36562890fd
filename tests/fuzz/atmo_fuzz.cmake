# The fuzzer of the .atmo language; the library gets the instrumentation too, or the fuzzer would be blind.
add_executable(atmo_fuzz ${CMAKE_CURRENT_LIST_DIR}/atmo_fuzz.cpp)
target_link_libraries(atmo_fuzz PRIVATE sky_options sky_atmo)
target_link_options(atmo_fuzz PRIVATE -fsanitize=fuzzer)
target_compile_options(atmo_fuzz PRIVATE -fsanitize=fuzzer)
target_compile_options(sky_atmo PRIVATE -fsanitize=fuzzer-no-link)
