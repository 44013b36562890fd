// showmysky render: draws without a window, one picture or numbered frames.

#include "base/error.hpp"
#include "developer.hpp"
#include "gl/context.hpp"
#include "picture.hpp"
#include "scene_file.hpp"
#include "subcommand.hpp"
#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <regex>

namespace showmysky::app {

namespace {

struct Animation {
    std::string name;
    double from = 0, to = 0;
    int frames = 1;
};

constexpr int mostFrames = 100000;

/// NAME=A..B:N
Animation parseAnimation(const std::string& text)
{
    static const std::regex form(R"(([a-z-]+)=([-+0-9.eE]+?)\.\.([-+0-9.eE]+):([0-9]{1,6}))");
    std::smatch match;
    if (std::regex_match(text, match, form)) {
        try {
            const Animation result{match[1], std::stod(match[2]), std::stod(match[3]), std::stoi(match[4])};
            if (result.frames >= 1 && result.frames <= mostFrames)
                return result;
        } catch (const std::exception&) { // not a number after all: the sentence below says what is
        }
    }
    throw sky::UsageError("--animate: `" + text + "` is not understood; expected NAME=FROM..TO:FRAMES, for instance " +
                          "sun-zenith=80..100:120, with 1 to " + std::to_string(mostFrames) + " frames.");
}

std::string framePath(const std::string& output, int frame, int frames)
{
    const std::filesystem::path path(output);
    std::string number = std::to_string(frame);
    const std::size_t digits = std::max<std::size_t>(4, std::to_string(frames - 1).size());
    number.insert(0, digits - std::min(digits, number.size()), '0');
    return (path.parent_path() / (path.stem().string() + "-" + number + path.extension().string())).string();
}

class Render : public Subcommand
{
public:
    CLI::App* addTo(CLI::App& app) override
    {
        auto* render = app.add_subcommand("render", "Draw pictures without a window");
        render->add_option("MODEL", model_, "model directory")->required();
        render->add_option("-o,--output", output_, "picture to write: .png or .exr")->required();
        render->add_option("--size", size_, "width x height in pixels")->capture_default_str()->group("Picture");
        render->add_option("--animate", animation_, "NAME=FROM..TO:FRAMES: numbered pictures over a range of an option")->group("Picture");
        render->add_flag("--gles", gles_, "use OpenGL ES 3.0 instead of OpenGL 3.3")->group("OpenGL");
        render->add_option("--save-scene", saveScene_, "write the scene of the options to this file too")->group("Scene");
        scene_.addTo(*render);
        return render;
    }

    int run() override
    {
        const auto [width, height] = parseSize();
        const std::string extension = std::filesystem::path(output_).extension().string();
        if (extension != ".png" && extension != ".exr")
            throw sky::UsageError("--output: `" + output_ + "` must end in .png or .exr.");
        const Animation animation = animation_.empty() ? Animation{} : parseAnimation(animation_);
        if (!animation_.empty())
            scene_.number(animation.name);
        if (!saveScene_.empty())
            saveScene(scene_, saveScene_);

        sky::gl::HeadlessOptions headless;
        headless.version = gles_ ? sky::gl::Version{3, 0, true} : sky::gl::Version{3, 3, false};
        sky::gl::HeadlessContext context(headless);
        Options options;
        options.log = [](const std::string& text) { std::cerr << "showmysky: " << text << '\n'; };
        Sky sky(model_, context.loader(), options);
        sky.loadAll();
        Developer developer(context.api());
        for (int frame = 0; frame < animation.frames; ++frame) {
            std::string path = output_;
            if (!animation_.empty()) {
                const double share = animation.frames > 1 ? double(frame) / (animation.frames - 1) : 0;
                scene_.number(animation.name) = animation.from + share * (animation.to - animation.from);
                path = framePath(output_, frame, animation.frames);
            }
            sky.setSettings(scene_.settings(sky));
            sky.draw(scene_.camera(), width, height);
            const Picture picture{sky.width(), sky.height(), sky.readLuminance()};
            const auto& development = scene_.development;
            if (extension == ".png")
                writePng(path, developer.levels(sky.luminanceTexture(), width, height, development,
                                                development.automatic ? automaticExposure(picture) : development.exposure));
            else
                writeExr(path, picture);
            std::cout << path << std::endl;
        }
        return 0;
    }

private:
    std::pair<int, int> parseSize() const
    {
        int width = 0, height = 0;
        char rest = 0;
        if (std::sscanf(size_.c_str(), "%5dx%5d%c", &width, &height, &rest) != 2 || width < 1 || height < 1)
            throw sky::UsageError("--size: `" + size_ + "` is not understood; expected WIDTHxHEIGHT, for instance 1280x720.");
        return {width, height};
    }

    std::string model_, output_, size_ = "1280x720", animation_, saveScene_;
    bool gles_ = false;
    SceneOptions scene_;
};

} // namespace

std::unique_ptr<Subcommand> makeRender() { return std::make_unique<Render>(); }

} // namespace showmysky::app
