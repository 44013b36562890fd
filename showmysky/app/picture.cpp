#include "picture.hpp"

#include "base/error.hpp"
#include "physics/colour.hpp"
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfOutputFile.h>
#include <memory>
#include <png.h>

namespace showmysky::app {

double automaticExposure(const Picture& picture)
{
    std::vector<float> luminances;
    double sum = 0;
    for (const auto& pixel : picture.pixels)
        if (pixel.y > 0) {
            luminances.push_back(pixel.y);
            sum += std::log(static_cast<double>(pixel.y));
        }
    if (luminances.empty())
        return 0;
    const double mean = std::exp(sum / static_cast<double>(luminances.size()));
    const auto bright = luminances.begin() + static_cast<std::ptrdiff_t>(luminances.size() * 98 / 100);
    std::nth_element(luminances.begin(), bright, luminances.end());
    // Dusk is to look darker than day, though by far less than it is: the eye adapts, but not wholly.
    const double dimming = std::clamp(std::pow(mean / 3000, 0.06), 0.4, 1.);
    return std::log10(dimming * std::min(0.4 / mean, 2.0 / static_cast<double>(*bright)));
}

void writePng(const std::string& path, const Levels& levels)
{
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = static_cast<png_uint_32>(levels.width);
    image.height = static_cast<png_uint_32>(levels.height);
    image.format = PNG_FORMAT_RGB;
    const auto bottomFirst = -static_cast<png_int_32>(PNG_IMAGE_ROW_STRIDE(image));
    if (!png_image_write_to_file(&image, path.c_str(), 0, levels.rgb.data(), bottomFirst, nullptr))
        throw sky::FileError("Cannot write `" + path + "`: " + image.message + ".");
}

void writeExr(const std::string& path, const Picture& picture)
{
    constexpr std::array<const char*, 7> names{"R", "G", "B", "X", "Y", "Z", "scotopic"};
    const std::size_t channels = names.size(), width = static_cast<std::size_t>(picture.width);
    std::vector<float> values;
    values.reserve(picture.pixels.size() * channels);
    for (int y = 0; y < picture.height; ++y)
        for (std::size_t x = 0; x < width; ++x) {
            const auto& p = picture.pixels[static_cast<std::size_t>(picture.height - 1 - y) * width + x];
            const auto rgb = sky::physics::linearSrgb({static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z)});
            for (const double c : rgb)
                values.push_back(static_cast<float>(c));
            values.insert(values.end(), {p.x, p.y, p.z, p.scotopic});
        }
    try {
        Imf::Header header(picture.width, picture.height);
        Imf::FrameBuffer frame;
        for (std::size_t c = 0; c < channels; ++c) {
            header.channels().insert(names[c], Imf::Channel(Imf::FLOAT));
            frame.insert(names[c], Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(values.data() + c), channels * sizeof(float),
                                              channels * width * sizeof(float)));
        }
        Imf::OutputFile file(path.c_str(), header);
        file.setFrameBuffer(frame);
        file.writePixels(picture.height);
    } catch (const std::exception& error) {
        throw sky::FileError("Cannot write `" + path + "`: " + error.what() + ".");
    }
}

} // namespace showmysky::app
