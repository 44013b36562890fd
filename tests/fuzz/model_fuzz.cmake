# The fuzzer of the model reader; the library gets the instrumentation too, or the fuzzer would be blind.
add_executable(model_fuzz ${CMAKE_CURRENT_LIST_DIR}/model_fuzz.cpp)
target_link_libraries(model_fuzz PRIVATE sky_options sky_model)
target_link_options(model_fuzz PRIVATE -fsanitize=fuzzer)
target_compile_options(model_fuzz PRIVATE -fsanitize=fuzzer)
target_compile_options(sky_model PRIVATE -fsanitize=fuzzer-no-link)
