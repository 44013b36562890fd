# What the tests of photometry need beside their sources: processes, and the Python module where numpy is there.
target_sources(test_showmysky PRIVATE ../calcmysky/process.cpp)
find_package(Python3 COMPONENTS Interpreter)
if(Python3_FOUND)
    execute_process(COMMAND ${Python3_EXECUTABLE} -c "import numpy" RESULT_VARIABLE withoutNumpy OUTPUT_QUIET ERROR_QUIET)
    if(NOT withoutNumpy)
        add_test(NAME "showmysky: Python module"
                 COMMAND ${Python3_EXECUTABLE} ${CMAKE_CURRENT_LIST_DIR}/photometry_python.py ${PROJECT_BINARY_DIR}/lib ${model}
                         ${PROJECT_SOURCE_DIR}/docs/photometry.md)
        set_tests_properties("showmysky: Python module" PROPERTIES FIXTURES_REQUIRED earth_small)
    else()
        message(STATUS "The Python module is not tested: numpy is missing (Debian: python3-numpy)")
    endif()
endif()
