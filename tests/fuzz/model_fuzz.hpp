#pragma once
// What must hold for any bytes taken as what a stranger's model makes us parse ourselves: manifest.json and the header of an EXR file. The
// fuzzer and an ordinary test share it.

#include "base/error.hpp"
#include "model/exr_header.hpp"
#include "model/manifest.hpp"

#include <sstream>
#include <stdexcept>
#include <string>

namespace fuzz {

/// A manifest is refused with a ModelError, or can be written and then says the same. Anything else gets out.
inline void checkManifest(const std::string& text)
{
    using namespace sky::model;
    try {
        const std::string written = writeManifest(parseManifest(text, "fuzz"));
        if (writeManifest(parseManifest(written, "fuzz")) != written)
            throw std::logic_error("the manifest that was written says something else");
    } catch (const sky::ModelError&) {
    }
}

/// A table whose file is tests/fuzz/model_seeds/header.exr.
inline sky::model::Table tableOfTheHeader()
{
    sky::model::Table table;
    table.name = "t";
    table.axes = {{"row", "1", {0, 1, 2, 3}}, {"column", "1", {0, 1}}};
    table.channelNames = {"X", "Y"};
    return table;
}

/// An EXR header is refused with a ModelError or taken. Anything else gets out.
inline void checkHeader(const std::string& bytes)
{
    try {
        std::istringstream stream(bytes);
        sky::model::checkExrHeader(stream, bytes.size(), tableOfTheHeader(), "fuzz");
    } catch (const sky::ModelError&) {
    }
}

} // namespace fuzz
