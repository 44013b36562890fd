# The window of `showmysky`: GLFW and Dear ImGui. Without them the program is built all the same and says what is missing.
find_package(glfw3 3.3 QUIET)
find_library(IMGUI_LIBRARY imgui)
find_library(STB_LIBRARY stb) # Debian's Dear ImGui leaves these functions to libstb
find_path(IMGUI_INCLUDE_DIR imgui.h PATH_SUFFIXES imgui)
set(preview ${CMAKE_CURRENT_SOURCE_DIR}/app/preview)
set(SHOWMYSKY_HAS_WINDOW OFF CACHE INTERNAL "The program showmysky opens windows")
if(glfw3_FOUND AND IMGUI_LIBRARY AND IMGUI_INCLUDE_DIR)
    set(SHOWMYSKY_HAS_WINDOW ON CACHE INTERNAL "The program showmysky opens windows")
    file(GLOB sources CONFIGURE_DEPENDS ${preview}/*.cpp)
    list(REMOVE_ITEM sources ${preview}/without_window.cpp)
    # Where the pointer is in the sky: the projections' own formulas, which the library doesn't export.
    target_sources(showmysky PRIVATE ${sources} ${CMAKE_CURRENT_SOURCE_DIR}/src/view_direction.cpp)
    target_include_directories(showmysky SYSTEM PRIVATE ${IMGUI_INCLUDE_DIR})
    target_link_libraries(showmysky PRIVATE glfw ${IMGUI_LIBRARY} $<$<BOOL:${STB_LIBRARY}>:${STB_LIBRARY}>
        ${CMAKE_DL_LIBS} nlohmann_json::nlohmann_json)
    if(CALCMYSKY_SANITIZE)
        target_sources(showmysky PRIVATE ${PROJECT_SOURCE_DIR}/cmake/keep_loaded.cpp)
        set_source_files_properties(${PROJECT_SOURCE_DIR}/cmake/keep_loaded.cpp PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
    endif()
else()
    message(STATUS "GLFW 3.3 or Dear ImGui is missing: showmysky is built without its window")
    target_sources(showmysky PRIVATE ${preview}/without_window.cpp)
endif()
