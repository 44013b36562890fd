#pragma once
// Reading a model directory. It may come from a stranger: whatever is wrong with it becomes a ModelError.

#include "model/manifest.hpp"
#include <filesystem>

namespace sky::model {

/// An opened model: its manifest, and its tables on request. Const functions may be called from several threads at once.
class Model
{
public:
    /// Reads and checks manifest.json, and that all files are there with the sizes it says.
    ///   throws ModelError
    static Model open(const std::filesystem::path& directory);

    const std::filesystem::path& directory() const { return directory_; }
    const Manifest& manifest() const { return manifest_; }
    const std::vector<Table>& tables() const { return manifest_.tables; }
    bool hasTable(const std::string& name) const;
    /// throws ModelError naming the tables that there are
    const Table& table(const std::string& name) const;

    /// All values, [rows][columns][channels], the last running fastest; channels in the order of Table::channelNames.
    ///   throws ModelError
    std::vector<float> readAll(const std::string& name) const;

    /// Some rows only; the rest of the file is not read.
    ///   throws ModelError; RangeError if there are no such rows
    std::vector<float> readRows(const std::string& name, int firstRow, int rowCount) const;

    /// Content of a text file of the model, for instance "description.atmo".   throws ModelError
    std::string text(const std::string& file) const;

    /// Reads every file and compares its checksum.   throws ModelError naming the first that differs
    void verifyChecksums() const;

private:
    std::filesystem::path directory_;
    Manifest manifest_;
};

} // namespace sky::model
