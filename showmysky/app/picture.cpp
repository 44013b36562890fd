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

namespace {

using Rgb = std::array<double, 3>;

/// Towards grey of the same luminance until no component is negative.
Rgb intoGamut(Rgb colour, double luminance)
{
    double keep = 1;
    for (const double c : colour)
        if (c < 0)
            keep = std::min(keep, luminance / (luminance - c));
    for (double& c : colour)
        c = std::max(0., luminance + keep * (c - luminance));
    return colour;
}

Rgb developed(const Luminance& pixel, double factor, ToneCurve curve)
{
    const sky::physics::XYZ xyz{static_cast<double>(pixel.x) * factor, static_cast<double>(pixel.y) * factor,
                                static_cast<double>(pixel.z) * factor};
    Rgb colour = intoGamut(sky::physics::linearSrgb(xyz), xyz[1]);
    // As film does: a little more contrast, and thereby colour, about a middle tone; then light that saturates.
    // A trace of light leaks between the channels, so that what is far too bright, the Sun itself, ends white.
    constexpr double middle = 0.3, contrast = 1.25, leak = 0.01;
    for (double& c : colour)
        if (curve == ToneCurve::exponential)
            c = -std::expm1(-middle * std::pow((c + leak * (xyz[1] - c)) / middle, contrast));
        else if (curve == ToneCurve::reinhard)
            c /= 1 + xyz[1];
    return colour;
}

/// Threshold of an 8 x 8 ordered dither (Bayer 1973), 0..1 exclusive.
double ditherThreshold(int x, int y)
{
    int value = 0;
    for (int bit = 0; bit < 3; ++bit) {
        const int a = (x >> bit) & 1, b = (y >> bit) & 1;
        value |= ((a ^ b) << (5 - 2 * bit)) | (b << (4 - 2 * bit));
    }
    return (value + 0.5) / 64;
}

} // namespace

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

void writePng(const std::string& path, const Picture& picture, const Development& development)
{
    const double factor = std::pow(10., development.automatic ? automaticExposure(picture) : development.exposure);
    std::vector<std::uint8_t> bytes;
    bytes.reserve(picture.pixels.size() * 3);
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x) {
            const auto& pixel =
                picture
                    .pixels[static_cast<std::size_t>(picture.height - 1 - y) * static_cast<std::size_t>(picture.width) +
                            static_cast<std::size_t>(x)];
            for (const double c : developed(pixel, factor, development.curve)) {
                const double level = 255 * sky::physics::encodeSrgb(std::clamp(c, 0., 1.));
                bytes.push_back(static_cast<std::uint8_t>(std::min(255., std::floor(level + ditherThreshold(x, y)))));
            }
        }
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = static_cast<png_uint_32>(picture.width);
    image.height = static_cast<png_uint_32>(picture.height);
    image.format = PNG_FORMAT_RGB;
    if (!png_image_write_to_file(&image, path.c_str(), 0, bytes.data(), 0, nullptr))
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
            const auto rgb = sky::physics::linearSrgb(
                {static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z)});
            for (const double c : rgb)
                values.push_back(static_cast<float>(c));
            values.insert(values.end(), {p.x, p.y, p.z, p.scotopic});
        }
    try {
        Imf::Header header(picture.width, picture.height);
        Imf::FrameBuffer frame;
        for (std::size_t c = 0; c < channels; ++c) {
            header.channels().insert(names[c], Imf::Channel(Imf::FLOAT));
            frame.insert(names[c], Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(values.data() + c),
                                              channels * sizeof(float), channels * width * sizeof(float)));
        }
        Imf::OutputFile file(path.c_str(), header);
        file.setFrameBuffer(frame);
        file.writePixels(picture.height);
    } catch (const std::exception& error) {
        throw sky::FileError("Cannot write `" + path + "`: " + error.what() + ".");
    }
}

} // namespace showmysky::app
