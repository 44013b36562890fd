# How our own targets are compiled. Warnings and sanitizers: link `sky_options`.
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

# Loops over wavelengths become vector code only where comparisons and square roots need not report floating-point exceptions,
# which nothing here asks for: link `sky_vectors`. Values, infinities and NaNs stay as they are.
add_library(sky_vectors INTERFACE)
target_compile_options(sky_vectors INTERFACE -O3 -fno-trapping-math -fno-math-errno)

# Code of text, options and calls of drivers takes longer to optimise than it ever runs: link `sky_plain`.
add_library(sky_plain INTERFACE)
target_compile_options(sky_plain INTERFACE $<$<CONFIG:Release>:-O1>)
