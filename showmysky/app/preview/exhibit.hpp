#pragma once
// What is shown: the sky of a model directory, or of a description that is computed first, and again after every edit.

#include "computation.hpp"
#include "showmysky/sky.hpp"
#include "watch.hpp"
#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

namespace showmysky::app::preview {

/// The former sky stays until the next one is loaded. Lives in one OpenGL context, which is current in every call.
class Exhibit
{
public:
    using Clock = std::chrono::steady_clock;

    explicit Exhibit(GlLoader loader) : loader_(std::move(loader)) {}

    /// A path that ends in .atmo is a description, all others are model directories. Problems are kept, not thrown.
    void open(const std::filesystem::path& path);
    void reload();
    /// One step of what is under way; some tens of milliseconds at most.
    ///   returns  true if another sky is shown from now on
    bool update(Clock::time_point now = Clock::now());

    Sky* sky() { return shown_.get(); }
    bool empty() const { return path_.empty(); }
    const std::filesystem::path& path() const { return path_; }
    bool waiting() const { return computation_ || next_; }
    /// What is waited for, and how much of it is done, 0..1; empty where nothing is.
    std::string activity() const;
    double fraction() const;
    /// Why the path can't be shown, in whole sentences; empty where all is well.
    const std::string& problem() const { return problem_; }

private:
    bool isDescription() const;
    void beginLoading(const std::filesystem::path& modelDirectory);

    GlLoader loader_;
    std::filesystem::path path_;
    std::unique_ptr<Computation> computation_;
    std::optional<Watch> watch_;
    Clock::time_point lastLook_{};
    std::unique_ptr<Sky> shown_, next_;
    Progress progress_;
    std::string problem_;
};

} // namespace showmysky::app::preview
