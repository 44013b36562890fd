# Writes NAME.cpp and NAME.hpp; see Embed.cmake. Raw strings are cut in pieces below the compiler's limit.
string(REPLACE "|" ";" FILES "${FILES}")
set(body "#include \"${NAME}.hpp\"\n\nnamespace ${NAMESPACE} {\n\nstd::string_view source(std::string_view path)\n{\n")
foreach(file IN LISTS FILES)
    file(READ ${ROOT}/${file} text)
    string(REPLACE "\\" "\\\\" text "${text}")
    string(REPLACE "\"" "\\\"" text "${text}")
    string(REPLACE "\n" "\\n\"\n        \"" text "${text}")
    string(APPEND body "    if (path == \"${file}\")\n        return \"${text}\";\n")
endforeach()
string(APPEND body "    return {};\n}\n\n} // namespace ${NAMESPACE}\n")
file(WRITE ${DIRECTORY}/${NAME}.cpp "${body}")
file(WRITE ${DIRECTORY}/${NAME}.hpp
     "#pragma once\n#include <string_view>\n\nnamespace ${NAMESPACE} {\n\n/// Text of the embedded file, empty if there is none.\nstd::string_view source(std::string_view path);\n\n} // namespace ${NAMESPACE}\n")
