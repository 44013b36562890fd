// A program with shaders of its own: a chequered plain under the sky, seen through the air in between.
//     haze MODEL PICTURE.ppm

#include "context.h"
#define GL_GLEXT_PROTOTYPES
#include <cmath>
#include <cstdio>
#include <GL/gl.h>
#include <GL/glext.h>
#include <showmysky/sky.hpp>
#include <vector>

namespace {

constexpr int width = 320, height = 200;

const char* const vertexShader = R"(#version 330 core
void main()
{
    gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0);
}
)";

// After the library's functions. The camera looks North; x is North, y West, z up.
const char* const planeShader = R"(
uniform float cameraAltitude;
out vec4 colour;

void main()
{
    vec2 p = (2.0 * gl_FragCoord.xy - vec2(320.0, 200.0)) / 320.0;
    vec3 direction = normalize(vec3(1.0, -p.x, p.y));
    float distance = cameraAltitude / max(-direction.z, 1e-9);
    if (direction.z > -0.02) { // beyond, a plain would have to be curved
        colour = showmyskyRadiance(direction);
        return;
    }
    vec2 place = direction.xy * distance / 1000.0;
    float albedo = (int(floor(place.x)) + int(floor(place.y))) % 2 == 0 ? 0.3 : 0.05;
    vec4 light = showmyskySunIlluminance(vec3(0.0, 0.0, 1.0)) + showmyskySkyIlluminance();
    colour = showmyskyTransmittance(direction, distance) * light * albedo / 3.14159265 + showmyskyRadianceTo(direction, distance);
}
)";

GLuint compiled(GLenum kind, const std::string& text)
{
    const GLuint shader = glCreateShader(kind);
    const char* source = text.c_str();
    glShaderSource(shader, 1, &source, nullptr);
    glCompileShader(shader);
    GLint fine = 0;
    glGetShaderiv(shader, GL_COMPILE_STATUS, &fine);
    char log[2000] = "";
    if (!fine)
        glGetShaderInfoLog(shader, sizeof log, nullptr, log);
    std::printf("%s", log);
    return shader;
}

/// From X, Y, Z to bytes of sRGB.
void writePicture(const char* path, const std::vector<float>& picture, float white)
{
    std::FILE* file = std::fopen(path, "wb");
    if (!file)
        return;
    std::fprintf(file, "P6 %d %d 255\n", width, height);
    for (int y = height - 1; y >= 0; --y)
        for (int x = 0; x < width; ++x) {
            const float* p = &picture[4 * static_cast<std::size_t>(y * width + x)];
            for (const float linear : {3.2406f * p[0] - 1.5372f * p[1] - 0.4986f * p[2], -0.9689f * p[0] + 1.8758f * p[1] + 0.0415f * p[2],
                                       0.0557f * p[0] - 0.2040f * p[1] + 1.0570f * p[2]})
                std::fputc(static_cast<int>(255 * std::pow(std::fmin(std::fmax(linear / white, 0.f), 1.f), 1 / 2.2f) + 0.5f), file);
        }
    std::fclose(file);
}

} // namespace

int main(int argc, char** argv)
{
    if (argc != 3)
        return std::puts("usage: haze MODEL PICTURE.ppm"), 2;
    if (!make_context())
        return std::puts("no OpenGL 3.3 context"), 77;
    try {
        showmysky::Sky sky(argv[1], [](const char* name) { return reinterpret_cast<void*>(eglGetProcAddress(name)); });
        sky.loadAll();
        showmysky::SceneSettings scene;
        scene.altitude = 1500;
        scene.sun.zenithAngle = 1.2;
        scene.sun.azimuth = 2;
        sky.setSettings(scene);

        const GLuint program = glCreateProgram();
        glAttachShader(program, compiled(GL_VERTEX_SHADER, vertexShader));
        glAttachShader(program, compiled(GL_FRAGMENT_SHADER, "#version 330 core\n" + sky.shaderFunctions() + planeShader));
        glLinkProgram(program);
        sky.bindShaderFunctions(program, 0);

        GLuint vertices = 0, picture = 0, target = 0;
        glGenVertexArrays(1, &vertices);
        glBindVertexArray(vertices);
        glGenRenderbuffers(1, &picture);
        glBindRenderbuffer(GL_RENDERBUFFER, picture);
        glRenderbufferStorage(GL_RENDERBUFFER, GL_RGBA32F, width, height);
        glGenFramebuffers(1, &target);
        glBindFramebuffer(GL_FRAMEBUFFER, target);
        glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, picture);
        glViewport(0, 0, width, height);
        glUseProgram(program);
        glUniform1f(glGetUniformLocation(program, "cameraAltitude"), static_cast<float>(scene.altitude));
        glDrawArrays(GL_TRIANGLES, 0, 3);
        std::vector<float> pixels(4 * width * height);
        glReadPixels(0, 0, width, height, GL_RGBA, GL_FLOAT, pixels.data());
        writePicture(argv[2], pixels, 1.2e4f);

        // Squares near by are told apart more easily than far ones.
        const auto contrast = [&](int row) {
            float low = 1e9f, high = 0;
            for (int x = 0; x < width; ++x) {
                const float luminance = pixels[4 * static_cast<std::size_t>(row * width + x) + 1];
                low = std::fmin(low, luminance);
                high = std::fmax(high, luminance);
            }
            return (high - low) / (high + low);
        };
        const int lowest = 0, middle = 80, far = 93;
        std::printf("contrast of the plain: %.2f near, %.2f farther, %.2f far away\n", static_cast<double>(contrast(lowest)),
                    static_cast<double>(contrast(middle)), static_cast<double>(contrast(far)));
        return contrast(lowest) > contrast(middle) && contrast(middle) > contrast(far) && glGetError() == GL_NO_ERROR ? 0 : 1;
    } catch (const showmysky::Error& error) {
        std::printf("%s\n", error.what());
        return 1;
    }
}
