#pragma once
// What a table of a model is: axes, channels, and how both are laid out in an EXR image (docs/format.md).

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace sky::model {

/// How the nodes of an axis were chosen, for those who want the formula. Readers need only the nodes.
struct Mapping {
    std::string id = "nodes";                 ///< docs/format.md lists the known ones; "nodes" promises nothing
    std::map<std::string, double> parameters; ///< finite
    bool operator==(const Mapping&) const = default;
};

struct Axis {
    std::string name;          ///< for instance "sunZenithAngle"
    std::string unit;          ///< for instance "rad"; "1" for a plain index
    std::vector<double> nodes; ///< finite, at least one
    Mapping mapping = {};
    bool operator==(const Axis&) const = default;
};

/// What the channels of a table are.
enum class Channels {
    SpectralRadiance,      ///< one per wavelength, "S0.391,333nm"
    SpectralDimensionless, ///< one per wavelength, "T.391,333nm": transmittance and other quantities that don't emit
    Luminance,             ///< "X", "Y", "Z" (CIE 1931, cd m^-2) and "scotopic"
    Named                  ///< as `channelNames` says
};

/// A table to be written: the first `rowAxes` axes index scanlines, the others columns, the last of each running
/// fastest. With [altitude][sun zenith][view zenith][azimuth] and rowAxes = 2 an altitude is one run of scanlines.
struct TableSpec {
    std::string name;      ///< unique in the model, for instance "single-scattering/molecules"
    std::string file = {}; ///< relative to the model; empty: safeFileName(name)
    std::string quantity;  ///< for instance "radiance"
    std::string unit;      ///< for instance "W m^-2 sr^-1 nm^-1"
    std::vector<Axis> axes;
    int rowAxes = 1; ///< 1 .. axes.size()
    Channels channels = Channels::Named;
    std::vector<double> wavelengthsNm = {};     ///< spectral tables: one channel each
    std::vector<std::string> channelNames = {}; ///< Channels::Named only
    int significandBits = 24;                   ///< 1..24; values are rounded to that many, 24 keeps a float as it is
    bool isSigned = false;                      ///< negative values are legal

    int rows() const;    ///< product of the first rowAxes axes
    int columns() const; ///< product of the others; 1 if there are none
    int channelCount() const;
};

/// A table of a model that exists: its spec with channelNames filled for every kind, and how it is stored.
struct Table : TableSpec {
    bool half = false;             ///< 16-bit channels
    std::vector<int> rowExponents; ///< [rows] if `half`: the value is the stored one times 2^rowExponents[row]

    /// Values in `rowCount` rows.
    std::size_t valueCount(int rowCount) const;
    /// "altitude[3] = 1200 m, sunZenithAngle[0] = 0 rad, ..." of a texel, for messages.
    std::string describeTexel(int row, int column) const;
};

/// Channel names in the order of the table's values. EXR files sort theirs by name, so go by the name.
std::vector<std::string> channelNamesOf(const TableSpec& spec);

/// A file name for any text: letters, digits, '.', '-' and '/' stay, other bytes become _XX; ".exr" is appended.
/// Different names give different files.
std::string safeFileName(const std::string& name);

/// True for a relative path of plain names below the directory it is meant for: [A-Za-z0-9._-]+ separated by '/', none
/// starting with a dot.
bool isPlainRelativePath(const std::string& path);

/// Checks a spec: names, sizes, axes, wavelengths.   throws RangeError naming table, value and range
void validate(const TableSpec& spec);

} // namespace sky::model
