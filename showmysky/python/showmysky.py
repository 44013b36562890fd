"""Photometry of the sky in numpy arrays, over the C interface of libShowMySky (showmysky/photometry.h).

    >>> import showmysky
    >>> sky = showmysky.Photometer("model")
    >>> sky.radiance(altitude=0, sun_zenith=1.0, view_zenith=[0.2, 0.9], azimuth=0.5).shape
    (2, 16)

Metres and radians; azimuth is that of the view minus that of the Sun. Arguments may be arrays: they are broadcast
together, and answers have their shape with one more axis at the end. A Photometer may be used from several threads.
"""

import ctypes
import ctypes.util
import os
import pathlib

import numpy as np

ABI = 1
ZERO_ORDER, SINGLE_SCATTERING, MULTIPLE_SCATTERING, LIGHT_POLLUTION = 1, 2, 4, 8
WHOLE_SKY = ZERO_ORDER | SINGLE_SCATTERING | MULTIPLE_SCATTERING


class Error(RuntimeError):
    """What went wrong, in a sentence; `status` is that of enum showmysky_photometry_status."""

    def __init__(self, status, message):
        super().__init__(message)
        self.status = status


def _candidates():
    """Places of the library: $SHOWMYSKY_LIBRARY, beside this file, in lib beside its folder, where the system looks."""
    if "SHOWMYSKY_LIBRARY" in os.environ:
        return [os.environ["SHOWMYSKY_LIBRARY"]]
    here = pathlib.Path(__file__).resolve().parent
    names = ["libShowMySky.so", "libShowMySky.so.0", "libShowMySky.dylib", "ShowMySky.dll"]
    places = [here, *(parent / "lib" for parent in here.parents), *here.parents[:4]]
    found = [str(place / name) for place in places for name in names if (place / name).is_file()]
    return found + [name for name in [ctypes.util.find_library("ShowMySky"), "libShowMySky.so.0"] if name]


class _City(ctypes.Structure):
    _fields_ = [
        *((name, ctypes.c_double) for name in ("distance", "azimuth", "radius", "luminance")),
        ("spectrum", ctypes.POINTER(ctypes.c_double)),
        ("spectrum_count", ctypes.c_size_t),
    ]


def _load():
    problems = []
    for candidate in _candidates():
        try:
            library = ctypes.CDLL(candidate)
            break
        except OSError as error:
            problems.append(str(error))
    else:
        raise ImportError(
            "libShowMySky was not found. Set SHOWMYSKY_LIBRARY to its path. " + "; ".join(problems)
        )
    if library.showmysky_photometry_abi() != ABI:
        raise ImportError(f"The library has version {library.showmysky_photometry_abi()} of the interface; expected {ABI}.")
    handle, real, array = ctypes.c_void_p, ctypes.c_double, ctypes.POINTER(ctypes.c_double)
    library.showmysky_photometry_error.restype = ctypes.c_char_p
    library.showmysky_photometer_wavelength_count.restype = ctypes.c_size_t
    for name, arguments in {
        "open": [ctypes.c_char_p, ctypes.c_int, ctypes.POINTER(handle)],
        "close": [handle],
        "wavelength_count": [handle],
        "wavelengths": [handle, array],
        "solar_irradiance": [handle, array],
        "radiance": [handle, array, ctypes.c_size_t, ctypes.c_uint, array],
        "eclipsed_radiance": [handle, array, array, ctypes.c_size_t, ctypes.c_uint, array],
        "obscuration": [handle, array, array, array],
        "city_radiance": [handle, array, ctypes.c_size_t, ctypes.POINTER(_City), ctypes.c_size_t, array],
        "luminance": [handle, array, ctypes.c_size_t, ctypes.c_uint, array],
        "colour": [handle, array, array],
        "transmittance": [handle, real, real, array],
        "sun_irradiance": [handle, real, real, array],
        "horizontal_irradiance": [handle, real, real, array, array],
    }.items():
        getattr(library, "showmysky_photometer_" + name).argtypes = arguments
    return library


_library = _load()


def _pointer(array):
    return array.ctypes.data_as(ctypes.POINTER(ctypes.c_double))


def _check(status):
    if status:
        raise Error(status, _library.showmysky_photometry_error().decode())


class Photometer:
    """Answers photometric questions about the model in a directory."""

    def __init__(self, directory, reference=False):
        self._handle = ctypes.c_void_p()
        _check(_library.showmysky_photometer_open(os.fsencode(directory), int(reference), ctypes.byref(self._handle)))
        self._count = _library.showmysky_photometer_wavelength_count(self._handle)
        #: nm
        self.wavelengths = self._spectrum(_library.showmysky_photometer_wavelengths)
        #: W m^-2 nm^-1, above the atmosphere
        self.solar_irradiance = self._spectrum(_library.showmysky_photometer_solar_irradiance)

    def close(self):
        """Frees the model; also done when the object dies."""
        handle, self._handle = self._handle, ctypes.c_void_p()
        _library.showmysky_photometer_close(handle)

    def __del__(self):
        if getattr(self, "_handle", None):
            self.close()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def radiance(self, altitude, sun_zenith, view_zenith, azimuth=0.0, layers=WHOLE_SKY):
        """Spectral radiance, W m^-2 sr^-1 nm^-1: [..., wavelength]."""
        return self._views("radiance", self._count, altitude, sun_zenith, view_zenith, azimuth, layers)

    def eclipsed_radiance(
        self, altitude, sun_zenith, view_zenith, azimuth, moon_zenith, moon_azimuth, moon_distance, layers=WHOLE_SKY
    ):
        """The same while the Moon hides a part of the Sun; its azimuth, like the view's, minus that of the Sun."""
        arrays = np.broadcast_arrays(
            altitude, sun_zenith, 0.0, view_zenith, azimuth, moon_azimuth, moon_zenith, moon_distance
        )
        views = np.ascontiguousarray(np.stack(arrays[:5], axis=-1), dtype=float)
        moons = np.ascontiguousarray(np.stack(arrays[5:], axis=-1), dtype=float)
        result = np.empty(views.shape[:-1] + (self._count,))
        function = _library.showmysky_photometer_eclipsed_radiance
        _check(function(self._handle, _pointer(views), _pointer(moons), views.size // 5, layers, _pointer(result)))
        return result

    def obscuration(self, altitude, sun_zenith, moon_zenith, moon_azimuth, moon_distance):
        """Share of the Sun's disc that the Moon hides at the camera, 0..1."""
        view = np.array([altitude, sun_zenith, 0.0, 0.0, 0.0])
        moon = np.array([moon_azimuth, moon_zenith, moon_distance], dtype=float)
        result = np.empty(1)
        _check(_library.showmysky_photometer_obscuration(self._handle, _pointer(view), _pointer(moon), _pointer(result)))
        return float(result[0])

    def city_radiance(self, altitude, view_zenith, azimuth, cities):
        """Light of cities alone: [..., wavelength]. A city is (distance, azimuth, radius, luminance) or the same with a spectrum."""
        arrays = np.broadcast_arrays(altitude, 0.0, 0.0, view_zenith, azimuth)
        views = np.ascontiguousarray(np.stack(arrays, axis=-1), dtype=float)
        result = np.empty(views.shape[:-1] + (self._count,))
        table = (_City * len(cities))()
        spectra = []  # kept alive
        for entry, city in zip(table, cities):
            entry.distance, entry.azimuth, entry.radius, entry.luminance = city[:4]
            if len(city) > 4:
                spectra.append(np.ascontiguousarray(city[4], dtype=float))
                entry.spectrum, entry.spectrum_count = _pointer(spectra[-1]), spectra[-1].size
        _check(
            _library.showmysky_photometer_city_radiance(
                self._handle, _pointer(views), views.size // 5, table, len(cities), _pointer(result)
            )
        )
        return result

    def luminance(self, altitude, sun_zenith, view_zenith, azimuth=0.0, layers=WHOLE_SKY):
        """CIE 1931 X, Y, Z and scotopic luminance, cd m^-2: [..., 4]."""
        return self._views("luminance", 4, altitude, sun_zenith, view_zenith, azimuth, layers)

    def colour(self, spectrum):
        """X, Y, Z, scotopic of spectra on the model's wavelengths: [..., wavelength] to [..., 4]."""
        spectra = np.ascontiguousarray(spectrum, dtype=float)
        if spectra.shape[-1:] != (self._count,):
            raise ValueError(f"The last axis of the spectra must have {self._count} wavelengths, not {spectra.shape[-1:]}.")
        result = np.empty(spectra.shape[:-1] + (4,))
        for index in np.ndindex(spectra.shape[:-1]):
            row = np.empty(4)
            _check(_library.showmysky_photometer_colour(self._handle, _pointer(spectra[index]), _pointer(row)))
            result[index] = row
        return result

    def transmittance(self, altitude, view_zenith):
        """To space, 0..1; zero where the ground is in the way."""
        return self._spectrum(_library.showmysky_photometer_transmittance, altitude, view_zenith)

    def sun_irradiance(self, altitude, sun_zenith):
        """Of a plane that faces the Sun, W m^-2 nm^-1."""
        return self._spectrum(_library.showmysky_photometer_sun_irradiance, altitude, sun_zenith)

    def horizontal_irradiance(self, altitude, sun_zenith):
        """Of a horizontal surface, W m^-2 nm^-1: by the Sun, by the sky."""
        direct, diffuse = np.empty(self._count), np.empty(self._count)
        _check(
            _library.showmysky_photometer_horizontal_irradiance(
                self._handle, altitude, sun_zenith, _pointer(direct), _pointer(diffuse)
            )
        )
        return direct, diffuse

    def _spectrum(self, function, *arguments):
        result = np.empty(self._count)
        _check(function(self._handle, *arguments, _pointer(result)))
        return result

    def _views(self, what, width, altitude, sun_zenith, view_zenith, azimuth, layers):
        arrays = np.broadcast_arrays(altitude, sun_zenith, 0.0, view_zenith, azimuth)
        views = np.ascontiguousarray(np.stack(arrays, axis=-1), dtype=float)
        result = np.empty(views.shape[:-1] + (width,))
        function = getattr(_library, "showmysky_photometer_" + what)
        _check(function(self._handle, _pointer(views), views.size // 5, layers, _pointer(result)))
        return result
