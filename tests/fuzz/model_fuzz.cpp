// libFuzzer target for what a stranger's model makes us parse ourselves: manifest.json and the EXR header. Run as
//     model_fuzz -dict=tests/fuzz/model.dict CORPUS MODEL-DIRECTORY
#include "base/error.hpp"
#include "model/exr_header.hpp"
#include "model/manifest.hpp"

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <sstream>

namespace {

sky::model::Table tableOfTheHeader()
{
    sky::model::Table table;
    table.name = "t";
    table.axes = {{"row", "1", {0, 1, 2, 3}}, {"column", "1", {0, 1}}};
    table.channelNames = {"X", "Y"};
    return table;
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    const std::string text(reinterpret_cast<const char*>(data), size);
    try {
        const auto manifest = sky::model::parseManifest(text, "fuzz");
        // What was accepted can be written, and then says the same.
        const std::string written = sky::model::writeManifest(manifest);
        if (sky::model::writeManifest(sky::model::parseManifest(written, "fuzz")) != written)
            std::abort();
    } catch (const sky::ModelError&) {
    }
    try {
        std::istringstream stream(text);
        sky::model::checkExrHeader(stream, size, tableOfTheHeader(), "fuzz");
    } catch (const sky::ModelError&) {
    }
    return 0;
}
