// Phase functions of the radiation field, as series of Legendre polynomials cut at DEGREE.
uniform samplerBuffer phases; // [scatterer][l][set], (2l+1)/(4 pi) lambda_l

// Adds what scatterer i makes of the sunlight `lit` that it met.
void scatter(int i, vec4 lit[SETS], float nu, inout vec4 total[SETS])
{
    float p = 1.0, before = 0.0; // P_l(nu), P_(l-1)(nu)
    for (int l = 0; l <= DEGREE; ++l) {
        for (int q = 0; q < SETS; ++q)
            total[q] += p * lit[q] * texelFetch(phases, (i * (DEGREE + 1) + l) * totalSets + setIndex(q));
        float after = (float(2 * l + 1) * nu * p - float(l) * before) / float(l + 1);
        before = p;
        p = after;
    }
}
