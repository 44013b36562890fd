#include "model/exr_header.hpp"
#include "base/error.hpp"

#include <algorithm>
#include <array>
#include <set>

namespace sky::model {

namespace {

// The layout is that of "OpenEXR File Layout" (openexr.com): magic, version, attributes {name, type, size, value}.
constexpr std::uint32_t magic = 20000630, versionMask = 0xff, longNames = 0x400;
constexpr std::uint64_t maxHeaderBytes = 1 << 20;
enum Compression { none = 0, zips = 2, zip = 3, piz = 4 };
// All that a header of this format needs. Others, as previews, carry sizes that the library would trust.
constexpr std::array knownTypes{"chlist", "box2i", "compression", "lineOrder", "float", "int", "double", "v2f", "string"};

class HeaderReader
{
public:
    HeaderReader(std::istream& stream, std::uint64_t fileBytes, std::string place)
        : stream_(stream), left_(std::min(fileBytes, maxHeaderBytes)), place_(std::move(place))
    {
    }

    [[noreturn]] void fail(const std::string& what) const { throw ModelError(place_ + ": " + what + "."); }

    std::string bytes(std::uint64_t count)
    {
        if (count > left_)
            fail("the EXR header is cut off or longer than 1 MiB");
        left_ -= count;
        std::string text(count, '\0');
        if (!stream_.read(text.data(), static_cast<std::streamsize>(count)))
            fail("the EXR header is cut off");
        return text;
    }

    std::uint32_t integer()
    {
        const std::string b = bytes(4);
        return decode(b, 0);
    }

    std::string name()
    {
        std::string text;
        for (char c; (c = bytes(1)[0]) != '\0';) {
            text += c;
            if (text.size() > 255)
                fail("a name in the EXR header has more than 255 bytes");
        }
        return text;
    }

    static std::uint32_t decode(const std::string& b, std::size_t at)
    {
        std::uint32_t value = 0;
        for (std::size_t i = 4; i-- > 0;)
            value = value << 8 | static_cast<unsigned char>(b[at + i]);
        return value;
    }

private:
    std::istream& stream_;
    std::uint64_t left_;
    std::string place_;
};

void checkChannels(const HeaderReader& in, const std::string& value, const Table& table)
{
    std::set<std::string> missing(table.channelNames.begin(), table.channelNames.end());
    std::size_t at = 0;
    while (at < value.size() && value[at] != '\0') {
        const std::size_t end = value.find('\0', at);
        // After the name: pixel type, linearity and three bytes of padding, two sampling rates.
        if (end == std::string::npos || value.size() - end < 17)
            in.fail("the channel list of the EXR header is cut off");
        const std::string name = value.substr(at, end - at);
        const std::uint32_t type = HeaderReader::decode(value, end + 1);
        if (!missing.erase(name))
            in.fail("there is a channel '" + name + "' that the manifest does not name");
        if (type != (table.half ? 1u : 2u))
            in.fail("channel '" + name + "' does not hold " + (table.half ? "halves" : "floats") + " as the manifest says");
        if (HeaderReader::decode(value, end + 9) != 1 || HeaderReader::decode(value, end + 13) != 1)
            in.fail("channel '" + name + "' is subsampled");
        at = end + 17;
    }
    if (!missing.empty())
        in.fail("the channel '" + *missing.begin() + "' is missing");
}

} // namespace

void checkExrHeader(std::istream& stream, std::uint64_t fileBytes, const Table& table, const std::string& place)
{
    HeaderReader in(stream, fileBytes, place);
    if (fileBytes < 8 || in.integer() != magic)
        in.fail("not an OpenEXR file");
    const std::uint32_t version = in.integer();
    if ((version & versionMask) != 2 || (version & ~(versionMask | longNames)) != 0)
        in.fail("an OpenEXR file of one scanline image is expected");

    std::set<std::string> seen;
    for (std::string name; !(name = in.name()).empty();) {
        const std::string type = in.name();
        const std::string value = in.bytes(in.integer());
        if (std::find(knownTypes.begin(), knownTypes.end(), type) == knownTypes.end())
            in.fail("the EXR header has an attribute of the type '" + type + "', which this format does not use");
        if (!seen.insert(name).second)
            in.fail("the EXR header has '" + name + "' twice");
        if (name == "channels" && type == "chlist")
            checkChannels(in, value, table);
        else if ((name == "dataWindow" || name == "displayWindow") && type == "box2i" && value.size() == 16) {
            const std::array<std::uint32_t, 4> expected{0, 0, static_cast<std::uint32_t>(table.columns()) - 1,
                                                        static_cast<std::uint32_t>(table.rows()) - 1};
            for (std::size_t i = 0; i < 4; ++i)
                if (HeaderReader::decode(value, 4 * i) != expected[i])
                    in.fail("the image does not have " + std::to_string(table.columns()) + " x " + std::to_string(table.rows()) +
                            " texels as the manifest says");
        } else if (name == "compression" && type == "compression" && value.size() == 1) {
            if (value[0] != none && value[0] != zips && value[0] != zip && value[0] != piz)
                in.fail("the image is compressed by a method that this format does not use (none, ZIPS, ZIP or PIZ)");
        } else if (name == "channels" || name == "dataWindow" || name == "displayWindow" || name == "compression" || name == "type" ||
                   name == "tiles")
            in.fail("the EXR header has a malformed or unexpected '" + name + "'");
    }
    for (const char* needed : {"channels", "dataWindow", "displayWindow", "compression"})
        if (!seen.contains(needed))
            in.fail(std::string("the EXR header has no '") + needed + "'");
}

} // namespace sky::model
