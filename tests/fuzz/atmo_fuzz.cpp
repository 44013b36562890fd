// libFuzzer target for the .atmo language; run as
//     atmo_fuzz -dict=tests/fuzz/atmo.dict tests/fuzz/atmo_seeds tests/atmo/corpus examples
#include "atmo_fuzz.hpp"

#include <cstddef>
#include <cstdint>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    fuzz::checkDescription(text);
    fuzz::checkTable(text);
    return 0;
}
