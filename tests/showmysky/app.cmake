# The parts of the program `showmysky` that need no window: scenes as text, what a screen shows, input.
set(app ${PROJECT_SOURCE_DIR}/showmysky/app)
file(GLOB appSources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/app/*.cpp)
add_executable(test_showmysky_app ${appSources} ${app}/blue_noise.cpp ${app}/developer.cpp ${app}/picture.cpp
    ${app}/scene_fields.cpp ${app}/scene_file.cpp ${app}/solar_spectrum.cpp)
foreach(part computation input obscuration places preferences watch) # of the window, what needs none
    target_sources(test_showmysky_app PRIVATE ${app}/preview/${part}.cpp)
endforeach()
target_include_directories(test_showmysky_app PRIVATE ${app} ${PROJECT_SOURCE_DIR}/tests)
target_link_libraries(test_showmysky_app PRIVATE sky_options sky_test_main showmysky_static PNG::PNG OpenEXR::OpenEXR
    nlohmann_json::nlohmann_json)
catch_discover_tests(test_showmysky_app TEST_PREFIX "showmysky app: ")
