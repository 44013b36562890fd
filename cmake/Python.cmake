# SKY_PYTHON: a Python 3 that can import NumPy, for tests; false where there is none. The first in PATH need not be it: Debian's
# python3-numpy belongs to /usr/bin/python3.
set(SKY_PYTHON SKY_PYTHON-NOTFOUND CACHE FILEPATH "A Python 3 with NumPy")
if(NOT SKY_PYTHON)
    find_program(pythonInPath NAMES python3 python NO_CACHE)
    foreach(candidate ${pythonInPath} /usr/bin/python3 /usr/local/bin/python3)
        execute_process(COMMAND ${candidate} -c "import sys, numpy; sys.exit(sys.version_info < (3, 7))" RESULT_VARIABLE failed
                        OUTPUT_QUIET ERROR_QUIET)
        if(failed EQUAL 0)
            set(SKY_PYTHON ${candidate} CACHE FILEPATH "A Python 3 with NumPy" FORCE)
            break()
        endif()
    endforeach()
endif()
if(NOT SKY_PYTHON)
    message(STATUS "No Python 3 with NumPy (Debian: python3-numpy): the tests of the window and of the Python module are left out")
endif()
