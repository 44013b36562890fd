# Warnings and sanitizers for our own targets: link `sky_options`.
add_library(sky_options INTERFACE)
target_compile_options(sky_options INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Wold-style-cast
                                             -Wcast-align -Wunused -Woverloaded-virtual -Wdouble-promotion -Wformat=2 $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>)
if(CALCMYSKY_WERROR)
    target_compile_options(sky_options INTERFACE -Werror)
endif()
if(CALCMYSKY_SANITIZE)
    target_compile_options(sky_options INTERFACE -fsanitize=${CALCMYSKY_SANITIZE} -fno-omit-frame-pointer
                                                 -fno-sanitize-recover=undefined)
    target_link_options(sky_options INTERFACE -fsanitize=${CALCMYSKY_SANITIZE})
endif()
