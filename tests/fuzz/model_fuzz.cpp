// libFuzzer target for what a stranger's model makes us parse ourselves: manifest.json and what is made of it, EXR headers and pixels. Run as
//     TMPDIR=/dev/shm model_fuzz -dict=tests/fuzz/model.dict CORPUS tests/fuzz/model_seeds
#include "model_fuzz.hpp"

#include <cstddef>
#include <cstdint>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    static const fuzz::Models models;
    models.check({reinterpret_cast<const char*>(data), size});
    return 0;
}
