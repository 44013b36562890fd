# What the tests of photometry need beside their sources: processes, and the Python module where numpy is there.
target_sources(test_showmysky PRIVATE ../calcmysky/process.cpp ../montecarlo/sample_air.cpp)
if(SKY_PYTHON)
    add_test(NAME "showmysky: Python module"
             COMMAND ${SKY_PYTHON} ${CMAKE_CURRENT_LIST_DIR}/photometry_python.py ${PROJECT_BINARY_DIR}/lib ${model}
                     ${PROJECT_SOURCE_DIR}/docs/photometry.md)
    set_tests_properties("showmysky: Python module" PROPERTIES FIXTURES_REQUIRED earth_small)
endif()
