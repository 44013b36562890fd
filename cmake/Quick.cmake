# Where CALCMYSKY_QUICK is on, building from scratch takes a third of the time. Both ways serve; without it each file is compiled by
# itself, so that little is compiled after an edit, ccache works, and no file leans on what another includes.

# sky_compile_together(TARGET): its files are read as one. For code of text, options and widgets, where heavy headers (CLI11,
# JSON) and their inline functions are most of the work; a name in an unnamed namespace may occur once in such a target.
function(sky_compile_together target)
    if(CALCMYSKY_QUICK)
        set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 0)
    endif()
endfunction()

# GCC 12 doubts std::string's own code once its header is precompiled: these warnings are no errors then.
add_library(sky_precompiled INTERFACE)
target_compile_options(sky_precompiled INTERFACE $<$<CXX_COMPILER_ID:GNU>:-Wno-error=array-bounds -Wno-error=stringop-overflow
                                                 -Wno-error=stringop-overread -Wno-error=maybe-uninitialized>)

# sky_precompile(TARGET header...): headers that most of its files include are read once; sky_precompile_as(TARGET OTHER) takes what was
# read for another target of the same flags.
function(sky_precompile target)
    if(CALCMYSKY_QUICK)
        target_precompile_headers(${target} PRIVATE ${ARGN})
        target_link_libraries(${target} PRIVATE sky_precompiled)
    endif()
endfunction()
function(sky_precompile_as target other)
    if(CALCMYSKY_QUICK)
        target_precompile_headers(${target} REUSE_FROM ${other})
        target_link_libraries(${target} PRIVATE sky_precompiled)
    endif()
endfunction()
set(SKY_STANDARD_HEADERS <algorithm> <array> <atomic> <charconv> <cmath> <cstdint> <cstring> <filesystem> <functional> <future> <map> <memory>
    <mutex> <numbers> <optional> <set> <span> <sstream> <string> <string_view> <thread> <utility> <vector>)
