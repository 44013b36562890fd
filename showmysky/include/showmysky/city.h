/* A city in the plain C interfaces: City in settings.hpp. */
#ifndef SHOWMYSKY_CITY_H
#define SHOWMYSKY_CITY_H

#include <stddef.h>

/* A disc on the ground that glows evenly. */
typedef struct showmysky_city {
    double distance;        /* of its centre from the point below the camera, along the ground, m */
    double azimuth;         /* rad */
    double radius;          /* m */
    double luminance;       /* cd/m^2 */
    const double* spectrum; /* its shape, one value per wavelength; null: that of the model's light pollution */
    size_t spectrum_count;
} showmysky_city;

#endif
