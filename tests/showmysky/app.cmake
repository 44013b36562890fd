# The parts of the program `showmysky` that need no window: scenes as text, what a screen shows, input.
find_package(CLI11 CONFIG REQUIRED)
set(app ${PROJECT_SOURCE_DIR}/showmysky/app)
file(GLOB appSources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/app/*.cpp)
add_executable(test_showmysky_app ${appSources} ${app}/blue_noise.cpp ${app}/developer.cpp ${app}/picture.cpp
    ${app}/city_option.cpp ${app}/scene_fields.cpp ${app}/scene_file.cpp ${app}/scene_options.cpp ${app}/solar_spectrum.cpp)
foreach(part computation input places preferences watch) # of the window, what needs none
    target_sources(test_showmysky_app PRIVATE ${app}/preview/${part}.cpp)
endforeach()
target_include_directories(test_showmysky_app PRIVATE ${app} ${PROJECT_SOURCE_DIR}/tests)
target_link_libraries(test_showmysky_app PRIVATE sky_options sky_plain sky_test_main showmysky_static PNG::PNG OpenEXR::OpenEXR
    nlohmann_json::nlohmann_json CLI11::CLI11)
sky_compile_together(test_showmysky_app)
catch_discover_tests(test_showmysky_app TEST_PREFIX "showmysky app: ")

# The window itself, on a screen in memory. Label `window`: it needs Xvfb and xdotool, and is skipped without them.
if(SHOWMYSKY_HAS_WINDOW AND SKY_PYTHON)
    set(slowness 1)
    if(CALCMYSKY_SANITIZE)
        set(slowness 4)
    endif()
    add_test(NAME "showmysky: the window"
             COMMAND ${SKY_PYTHON} ${CMAKE_CURRENT_SOURCE_DIR}/preview_window.py $<TARGET_FILE:showmysky>
                     $<TARGET_FILE:calcmysky> ${model} ${PROJECT_SOURCE_DIR}/examples/earth-small.atmo
                     ${CMAKE_CURRENT_BINARY_DIR}/window ${slowness})
    set_tests_properties("showmysky: the window" PROPERTIES
        FIXTURES_REQUIRED earth_small LABELS window PROCESSORS 2 SKIP_RETURN_CODE 77)
else()
    message(STATUS "The window's test is left out: GLFW, Dear ImGui or a Python with NumPy is missing")
endif()
