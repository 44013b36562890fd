#include "context_for_tests.hpp"

#include <cstdlib>
#include <thread>

#include "gl/buffer.hpp"
#include "gl/timing.hpp"

using namespace sky;
using Catch::Matchers::Contains;

namespace {

gl::HeadlessOptions backend(gl::HeadlessBackend which)
{
    gl::HeadlessOptions options;
    options.backend = which;
    return options;
}

std::string failure(const gl::HeadlessOptions& options)
{
    try {
        const gl::HeadlessContext context(options);
    } catch (const GlError& error) {
        return error.what();
    }
    return "no error";
}

} // namespace

TEST_CASE("headless context: made and destroyed again and again", "[gl]")
{
    for (int i = 0; i < 4; ++i) {
        const auto context = gl::testing::context();
        if (!context)
            return;
        CHECK(context->api().atLeast(4, 3));
        CHECK_FALSE(context->api().renderer().empty());
        CHECK(context->api().limits().workGroupInvocations >= 1024); // minimum of OpenGL 4.3
        const gl::Buffer buffer(context->api(), "buffer", std::vector<float>{1.0f, 2.0f});
        CHECK(buffer.download() == std::vector<float>{1.0f, 2.0f});
    }
}

TEST_CASE("headless context: no display server is needed", "[gl]")
{
    if (!gl::testing::context())
        return;
    unsetenv("DISPLAY");
    unsetenv("WAYLAND_DISPLAY");
    const auto context = gl::testing::context(backend(gl::HeadlessBackend::egl));
    if (context)
        CHECK_THAT(context->description(), Contains("EGL"));
}

TEST_CASE("headless context: two at once keep their objects apart, whichever is current when they die", "[gl]")
{
    auto first = gl::testing::context();
    if (!first)
        return;
    const gl::Buffer keeper(first->api(), "keeper", std::vector<float>{7.0f});
    std::optional<gl::Buffer> dying(std::in_place, first->api(), "dying", std::vector<float>{8.0f});
    const GLuint dyingName = dying->name();

    gl::HeadlessContext second;
    const gl::Buffer one(second.api(), "one", std::vector<float>{1.0f});
    const gl::Buffer two(second.api(), "two", std::vector<float>{2.0f});
    dying.reset(); // belongs to the first context while the second one is current
    CHECK(one.download() == std::vector<float>{1.0f});
    CHECK(two.download() == std::vector<float>{2.0f});
    CHECK(second.api()->IsBuffer(dyingName) == GL_TRUE); // the second context's own buffer of that name

    first->makeCurrent();
    CHECK(first->api()->IsBuffer(dyingName) == GL_FALSE);
    CHECK(keeper.download() == std::vector<float>{7.0f});
}

TEST_CASE("headless context: objects may outlive it", "[gl]")
{
    auto context = gl::testing::context();
    if (!context)
        return;
    const gl::Buffer buffer(context->api(), "survivor", std::vector<float>{1.0f});
    const gl::Sync sync(context->api());
    context.reset();
    CHECK_FALSE(buffer.api().alive()); // the destructor runs after this line and must not call the driver
}

TEST_CASE("headless context: moves to another thread", "[gl]")
{
    auto context = gl::testing::context();
    if (!context)
        return;
    context->release();
    std::vector<float> result;
    std::thread([&] {
        context->makeCurrent();
        result = gl::Buffer(context->api(), "buffer", std::vector<float>{3.0f}).download();
        context->release();
    }).join();
    CHECK(result == std::vector<float>{3.0f});
}

TEST_CASE("OSMesa: makes a core context", "[gl]")
{
    const auto context = gl::testing::context(backend(gl::HeadlessBackend::osmesa));
    if (!context)
        return;
    CHECK(context->description() == "OSMesa");
    CHECK(context->api().isSoftware());
    CHECK(context->api().hasCompute());
    const gl::Buffer buffer(context->api(), "buffer", std::vector<float>{5.0f});
    CHECK(buffer.download() == std::vector<float>{5.0f});
}

TEST_CASE("OSMesa: is the fallback where EGL is missing", "[gl]")
{
    gl::HeadlessOptions options;
    options.eglLibrary = "libNoSuchEGL.so.1";
    const auto context = gl::testing::context(options);
    if (context)
        CHECK(context->description() == "OSMesa");
}

TEST_CASE("OpenGL ES 3.0: a context for the renderer's tests", "[gl]")
{
    gl::HeadlessOptions options;
    options.version = {3, 0, true};
    const auto context = gl::testing::context(options);
    if (!context)
        return;
    CHECK(context->api().isEs());
    CHECK_FALSE(context->api().hasCompute());
    const gl::Buffer buffer(context->api(), "buffer", std::vector<float>{5.0f, 6.0f});
    CHECK(buffer.download() == std::vector<float>{5.0f, 6.0f});
}

TEST_CASE("devices: listed with their renderer, and each can be chosen", "[gl]")
{
    if (!gl::testing::context(backend(gl::HeadlessBackend::egl)))
        return;
    const std::vector<gl::DeviceInfo> devices = gl::listDevices();
    for (const gl::DeviceInfo& device : devices) {
        CAPTURE(device.index, device.problem);
        if (!device.problem.empty())
            continue;
        CHECK_FALSE(device.renderer.empty());
        gl::HeadlessOptions options;
        options.device = device.index;
        const gl::HeadlessContext context(options);
        CHECK(context.api().renderer() == device.renderer);
        CHECK(context.api().isSoftware() == device.software);
        CHECK(context.description() == "EGL device " + std::to_string(device.index));
    }
    gl::HeadlessOptions beyond;
    beyond.device = static_cast<int>(devices.size());
    CHECK_THAT(failure(beyond), Contains("there is no device " + std::to_string(devices.size())));
}

TEST_CASE("headless context: without any OpenGL the error says what was tried and what to install")
{
    gl::HeadlessOptions options;
    options.eglLibrary = "libNoSuchEGL.so.1";
    options.osmesaLibrary = "libNoSuchOSMesa.so.8";
    const std::string message = failure(options);
    CHECK_THAT(message, Contains("No OpenGL 4.3 context") && Contains("EGL: libNoSuchEGL.so.1 can't be loaded") &&
                            Contains("OSMesa: libNoSuchOSMesa.so.8 can't be loaded") && Contains("apt-get install"));
    CHECK(gl::listDevices(options).empty());
}

TEST_CASE("debug output: the driver's messages reach the sink", "[gl]")
{
    std::string heard;
    gl::HeadlessOptions options;
    options.debug = gl::DebugOutput::on;
    options.debugSink = [&](const std::string& message) { heard += message + "\n"; };
    auto context = gl::testing::context(options);
    if (!context)
        return;
    const gl::HeadlessContext moved = std::move(*context); // the sink must survive this
    moved.api()->Enable(GL_TEXTURE_3D);                    // not a switch of the core profile
    CHECK_THAT(heard, Contains("OpenGL error"));
    CHECK_THROWS_WITH(gl::checkErrors(moved.api(), "moments", "order 2"), "moments (order 2): OpenGL reports GL_INVALID_ENUM.");
    CHECK_NOTHROW(gl::checkErrors(moved.api(), "moments")); // read once, gone
}

TEST_CASE("borrowed context: works through the host's loader; given up, it is left alone", "[gl]")
{
    const auto host = gl::testing::context();
    if (!host)
        return;
    const gl::BorrowedContext borrowed(host->loader());
    CHECK(borrowed.api().renderer() == host->api().renderer());
    GLuint abandoned = 0;
    {
        const gl::Buffer lent(borrowed.api(), "lent", std::vector<float>{4.0f});
        CHECK(lent.download() == std::vector<float>{4.0f});
        const gl::Buffer kept(borrowed.api(), "kept", std::vector<float>{5.0f});
        abandoned = kept.name();
        borrowed.abandon();
    }
    CHECK(host->api()->IsBuffer(abandoned) == GL_TRUE); // its owner died without a call
    CHECK_THROWS_AS(gl::BorrowedContext(gl::Loader([](const char*) -> void* { return nullptr; })), GlError);
    host->api()->DeleteBuffers(1, &abandoned);
}

TEST_CASE("timer and fence: tell when the GPU is done", "[gl]")
{
    const auto context = gl::testing::context();
    if (!context)
        return;
    gl::TimerQuery timer(context->api(), "timer");
    timer.begin();
    const gl::Buffer buffer(context->api(), "buffer", std::vector<float>(1000, 1.0f));
    timer.end();
    const gl::Sync sync(context->api());
    CHECK(sync.wait(std::chrono::seconds(10)));
    CHECK(timer.seconds() >= 0.0);
    CHECK(timer.seconds() < 10.0);
    gl::checkErrors(context->api(), "test");
}
