// libFuzzer target for what a stranger's model makes us parse ourselves: manifest.json and the EXR header. Run as
//     model_fuzz -dict=tests/fuzz/model.dict CORPUS tests/fuzz/model_seeds
#include "model_fuzz.hpp"

#include <cstddef>
#include <cstdint>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    const std::string text(reinterpret_cast<const char*>(data), size);
    fuzz::checkManifest(text);
    fuzz::checkHeader(text);
    return 0;
}
