# The Python module stands beside the library where it is built, and in site-packages style where it is installed.
configure_file(python/showmysky.py ${PROJECT_BINARY_DIR}/lib/showmysky.py COPYONLY)
install(FILES python/showmysky.py DESTINATION ${CMAKE_INSTALL_DATADIR}/showmysky/python)
