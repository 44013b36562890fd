// Light scattered along a ray, summed over its nodes (libs/physics/ray.hpp): the radiance moments at each node meet the ray's
// direction there. What depends on the ray alone is already folded into the node's azimuthal terms:
//     g_m = sum_l sum_i w_i lambda_l,i (I_lm / I_00) P_lm(mu_k),       L = sum_k I_00 sum_m g_m cos(m phi_k)
// The solver shares the nodes' terms out among stations, fewer places at which to look at the Sun (libs/solver/stations.hpp).

// cos(phi) between a direction and the Sun as seen at a node: from nu = mu muSun + sines cos(phi).
// Where either stands in the zenith, phi is anything, and the terms that need it vanish.
float azimuthCosine(float mu, float muSun, float nu)
{
    float sines = sqrt(max(0.0, (1.0 - mu * mu) * (1.0 - muSun * muSun)));
    return sines > 1e-6 ? clamp((nu - mu * muSun) / sines, -1.0, 1.0) : 1.0;
}
