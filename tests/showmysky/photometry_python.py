"""The Python module against the physics that needs no second program. Arguments: folder of the module, model, docs/photometry.md."""

import math
import re
import subprocess
import sys
import threading

sys.path.insert(0, sys.argv[1])
import numpy as np
import showmysky

sky = showmysky.Photometer(sys.argv[2])
exact = showmysky.Photometer(sys.argv[2], reference=True)
assert sky.wavelengths.shape == sky.solar_irradiance.shape and (np.diff(sky.wavelengths) > 0).all()

zenith = np.linspace(0, 1.4, 5)[:, None]
azimuth = np.array([0.5, 1.5, 3.0])
radiance = sky.radiance(0, 0.9, zenith, azimuth)
assert radiance.shape == (5, 3, len(sky.wavelengths)) and (radiance > 0).all()
assert np.abs(radiance / exact.radiance(0, 0.9, zenith, azimuth) - 1).max() < 0.003
assert np.allclose(sky.luminance(0, 0.9, zenith, azimuth), sky.colour(radiance), rtol=1e-9)
assert np.array_equal(sky.radiance(0, 0.9, zenith[1, 0], 0.5), radiance[1, 0])

assert 0 < sky.transmittance(0, 1.0)[1] < sky.transmittance(0, 0.0)[1] < 1
assert np.allclose(sky.sun_irradiance(1e6, 0.3), sky.solar_irradiance)
direct, diffuse = sky.horizontal_irradiance(0, 1.0)
assert (direct + diffuse <= 1.2 * math.cos(1.0) * sky.solar_irradiance).all() and (diffuse > 0).all()

for wrong in (lambda: sky.radiance(-1, 0, 0), lambda: sky.transmittance(0, math.nan), lambda: showmysky.Photometer("nowhere")):
    try:
        wrong()
    except showmysky.Error as error:
        assert len(str(error)) > 20
    else:
        raise AssertionError("no error was raised")

answers = [None] * 4
threads = [threading.Thread(target=lambda i=i: answers.__setitem__(i, sky.radiance(0, 0.9, zenith, azimuth))) for i in range(4)]
[thread.start() for thread in threads]
[thread.join() for thread in threads]
assert all(np.array_equal(answer, radiance) for answer in answers)

with open(sys.argv[3]) as page:
    samples = re.findall(r"```python\n(.*?)```", page.read(), re.S)
assert samples
for sample in samples:
    exec(sample.replace('"model"', repr(sys.argv[2])), {})
