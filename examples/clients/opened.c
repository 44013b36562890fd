/* A C program that opens the library at run time: prints the spectrum of a pixel.
 *     opened LIBRARY MODEL */

#include "context.h"
#include <dlfcn.h>
#include <showmysky/sky.h>
#include <string.h>

static void* library;

/* POSIX lets data pointers carry functions, ISO C wants them copied. */
static void find(void* function, const char* name)
{
    void* symbol = dlsym(library, name);
    if (!symbol)
        printf("the library lacks %s\n", name);
    memcpy(function, &symbol, sizeof symbol);
}

static void* load(const char* name, void* user)
{
    void (*function)(void) = eglGetProcAddress(name);
    void* result;
    (void)user;
    memcpy(&result, &function, sizeof result);
    return result;
}

#define FIND(name) find(&name, "showmysky_" #name)

int main(int argc, char** argv)
{
    int (*abi_version)(void);
    const char* (*error)(void);
    showmysky_sky* (*open)(const char*, showmysky_gl_loader, void*, const char*);
    void (*close)(showmysky_sky*);
    int (*load_all)(showmysky_sky*);
    void (*default_scene)(showmysky_scene*);
    int (*set_scene)(showmysky_sky*, const showmysky_scene*);
    int (*draw)(showmysky_sky*, const showmysky_camera*, int, int, int);
    const char* (*shader_functions)(showmysky_sky*);
    size_t (*wavelengths)(const showmysky_sky*, double*, size_t);
    int (*pixel_spectral_radiance)(showmysky_sky*, int, int, double*, size_t);
    showmysky_camera camera = {SHOWMYSKY_PERSPECTIVE, 1.2, 0, 0.7, 0};
    showmysky_scene scene;
    showmysky_sky* sky;
    double nm[64], radiance[64];
    size_t i, count;

    if (argc != 3) {
        puts("usage: opened LIBRARY MODEL");
        return 2;
    }
    if (!make_context()) {
        puts("no OpenGL 3.3 context");
        return 77;
    }
    library = dlopen(argv[1], RTLD_NOW | RTLD_LOCAL);
    if (!library) {
        puts(dlerror());
        return 1;
    }
    FIND(abi_version);
    if (abi_version() != SHOWMYSKY_ABI_VERSION) {
        puts("the library speaks another version of the interface");
        return 1;
    }
    FIND(error);
    FIND(open);
    FIND(close);
    FIND(load_all);
    FIND(default_scene);
    FIND(set_scene);
    FIND(draw);
    FIND(shader_functions);
    FIND(wavelengths);
    FIND(pixel_spectral_radiance);

    /* A mistake is a sentence, never an exception. */
    sky = open("no/such/model", load, NULL, NULL);
    if (!sky || load_all(sky) || !strlen(error()))
        return 1;
    printf("as it should be: %s\n", error());
    close(sky);

    sky = open(argv[2], load, NULL, NULL);
    default_scene(&scene);
    scene.altitude = 1500;
    if (!sky || !load_all(sky) || !set_scene(sky, &scene) || !draw(sky, &camera, 320, 200, 1)) {
        puts(error());
        return 1;
    }
    /* Text for fragment shaders of the program's own; haze.cpp draws with it. */
    if (!shader_functions(sky) || !strstr(shader_functions(sky), "vec4 showmyskyRadiance(vec3 direction)"))
        return 1;
    count = wavelengths(sky, nm, 64);
    if (!count || !pixel_spectral_radiance(sky, 160, 100, radiance, 64)) {
        puts(error());
        return 1;
    }
    for (i = 0; i < count && i < 64; ++i)
        printf("%8.3f nm  %.5g W m^-2 sr^-1 nm^-1\n", nm[i], radiance[i]);
    close(sky);
    return radiance[0] > 0 ? 0 : 1;
}
