"""Random legal descriptions over the whole range of the language, for campaign.py."""
import math

AU = 149597870700.0

PHASES = {
    "isotropic": "return vec4(1.0/(4.0*PI));",
    "Rayleigh": "return vec4(3.0/(16.0*PI)*(1.0+sqr(dotViewSun)));",
    "Henyey-Greenstein 0.5": None,
    "Henyey-Greenstein 0.9": None,
    "Henyey-Greenstein 0.99": None,
    "backward -0.8": None,
    "peak": "float x = acos(clamp(dotViewSun, -1.0, 1.0)) / 0.02; return vec4(0.5/(4.0*PI) + 0.5*exp(-x*x)/(PI*0.0004));",
}
GENTLE = ("isotropic", "Rayleigh", "Henyey-Greenstein 0.5")
MEAN_COSINE = {"isotropic": 0, "Rayleigh": 0, "peak": 0.5} # half of the light of the peak, which is a degree wide; others have it in their name


def phase_code(name):
    if PHASES[name]:
        return PHASES[name]
    g = float(name.split()[1])
    return f"const float g = {g}; return vec4((1.0-g*g)/(4.0*PI*pow(1.0+g*g-2.0*g*dotViewSun, 1.5)));"


def density_code(shape, peak, top, rng):
    """GLSL of a number density with the given peak, m^-3, and its column over the atmosphere, m^-2."""
    if shape == "exponential":
        scale = top / rng.uniform(4, 20)
        return f"return {peak:.9e}*exp(-altitude/{scale:.9e});", peak * scale * (1 - math.exp(-top / scale))
    if shape == "step":
        low = top * rng.uniform(0, 0.6)
        high = low + top * rng.uniform(0.02, 0.3)
        return f"return altitude >= {low:.9e} && altitude <= {high:.9e} ? {peak:.9e} : 0.0;", peak * (high - low)
    if shape == "stairs":
        return f"float x = altitude/{top:.9e}; return x < 0.2 ? {peak:.9e} : x < 0.3 ? 0.0 : x < 0.6 ? {peak / 3:.9e} : 0.0;", peak * top * 0.3
    if shape == "bump":
        centre, width = top * rng.uniform(0.1, 0.7), top * rng.uniform(0.02, 0.1)
        return (f"float x = (altitude-{centre:.9e})/{width:.9e}; return {peak:.9e}*max(0.0, 1.0-x*x);", peak * width * 4 / 3)
    if shape == "nothing":
        return "return 0.0;", peak * top
    return f"return {peak:.9e};", peak * top


def log_uniform(rng, low, high):
    """Over the range, and now and then at one of its ends."""
    if rng.random() < 0.15:
        return rng.choice([low, high])
    return math.exp(rng.uniform(math.log(low), math.log(high)))


def kinds_of(wavelengths, scatterers, species, scattered, sharp, albedo):
    """What is special about a scene, for campaign.py --must-hold."""
    found = [f"{wavelengths} wavelengths", f"{scatterers} scatterers"]
    found += ["deep"] if scattered >= 100 else ["vacuum"] if species == 0 else ["no sky"] if scattered == 0 else []
    return found + (["sharp over bright ground"] if sharp and min(albedo) >= 0.3 else [])


def spectrum(values):
    return ", ".join("%.9g" % v for v in values)


def scene(rng):
    """Text of a description, and what the checks need to know of it. Its `transport` is the vertical optical depth by wavelength that even light within
    a peak doesn't pass, tau (1 - omega g)."""
    planet, top = (float("%.9e" % log_uniform(rng, *ends)) for ends in ((1e5, 1e10), (1, 1e6))) # as written below
    count = rng.choice([4, 4, 4, 4, 5, 6, 16, 64])
    sun = rng.choice([0.5, 1.0, 1.0, 30.0, 1e20]) * AU
    albedo = rng.choice([[0.0] * count, [0.0] * count, [1.0] * count, [0.3] * count, [i / (count - 1) for i in range(count)]])
    scatterers = rng.choice([0, 20, len(PHASES)] + [1] * 9 + [2] * 5 + [3] * 3)
    orders = rng.choice([1, 2, 4, 4, "all"])
    size = lambda *choices: rng.choice(choices)
    lines = [
        "version: 6", f"Earth radius: {planet:.9e} m", f"atmosphere height: {top:.9e} m", f"Earth-Sun distance: {sun / AU:.9e} AU",
        "Earth-Moon distance: 384400 km", f"scattering orders: {orders}", f"wavelengths: min=400nm, max=700nm, count={count}",
        f"solar irradiance at TOA: {spectrum([1.0] * count)}", f"ground albedo: {spectrum(albedo)}",
        f"light pollution relative radiance: {spectrum([1e-5] * count)}",
        f"transmittance texture size for VZA: {size(2, 4)}", "transmittance texture size for altitude: 2",
        f"irradiance texture size for SZA: {size(2, 4)}", "irradiance texture size for altitude: 2",
        f"scattering texture size for VZA: {size(4, 8)}", "scattering texture size for dot(view,sun): 2",
        f"scattering texture size for SZA: {size(2, 5)}", "scattering texture size for altitude: 2",
        "eclipsed double scattering texture size for VZA: 4", "eclipsed double scattering texture size for SZA: 2",
        "eclipsed double scattering texture size for relative azimuth: 2",
        "light pollution texture size for VZA: 2", "light pollution texture size for altitude: 2",
    ]
    wavelengths = [0.4 + 0.3 * i / (count - 1) for i in range(count)] # um
    species, gentle, transport = [], True, [0.0] * count
    scattered, sharp = 0.0, False # vertical optical depth of scattering where it is largest; whether by sharp peaks
    for i in range(scatterers):
        depth = rng.choice([0.0, 1e-9, 1e-3, 0.1, 0.5, 1.0, 3.0, 10.0, 1000.0]) / (scatterers if scatterers > 3 else 1)
        phase = list(PHASES)[i] if scatterers == len(PHASES) else rng.choice(list(PHASES))
        shape = rng.choice(["exponential", "exponential", "exponential", "step", "stairs", "bump", "constant", "nothing"])
        omega = rng.choice([1.0, 1.0, 0.9, 0.0])
        code, column = density_code(shape, 1e20, top, rng)
        gentle = gentle and phase in GENTLE
        kind, angstrom = rng.choice(["smooth", "achromatic", "general"]), rng.choice([0, 0, 1.3, 4])
        if shape != "nothing":
            scattered += omega * depth * wavelengths[0]**-angstrom
            sharp = sharp or depth * omega >= 0.1 and phase not in GENTLE
            cosine = MEAN_COSINE[phase] if phase in MEAN_COSINE else float(phase.split()[1])
            transport = [sum_ + depth * wavelength**-angstrom * (1 - omega * cosine) for sum_, wavelength in zip(transport, wavelengths)]
        species.append(f"{phase} {shape} {depth:.3g} {omega:g}")
        lines += [f'Scatterer "s{i}":', "{", "number density:", "```", code, "```", "phase function:", "```", phase_code(phase), "```",
                  f"phase function type: {kind}",
                  f"cross section at 1 um: {depth / column:.9e} m^2", f"angstrom exponent: {angstrom}",
                  f"single scattering albedo: {spectrum([omega] * count)}", "}"]
    if rng.random() < 0.3:
        species.append("an absorber")
        depth = rng.choice([0.0, 1.0, 1000.0])
        transport = [sum_ + 0.7 * depth for sum_ in transport]
        lines += ['Absorber "a":', "{", "number density:", "```", "return altitude > 0.3*atmosphereHeight ? 1.0 : 0.0;", "```",
                  f"cross section: {spectrum([depth / top] * count)}", "}"]
    about = (f"R {planet:.2g} m, top {top:.2g} m, Sun {sun / AU:g} AU, {count} wavelengths, albedo {albedo[0]:g}..{albedo[-1]:g}, orders {orders}: "
             + ("; ".join(species[:3]) or "vacuum") + (" ..." if len(species) > 3 else ""))
    kinds = kinds_of(count, scatterers, len(species), scattered, sharp, albedo)
    return "\n".join(lines) + "\n", {"top": top, "planet": planet, "albedo": albedo, "wavelengths": [1000 * w for w in wavelengths],
                                     "transport": transport, "gentle": gentle, "scatters": scattered > 0, "about": about, "kinds": kinds,
                                     "eclipsed": scatterers < 3 and rng.random() < 0.2}
