// The IRI of elevations in m, one per line, 25 mm apart or as the first argument says.
#include "floatref.hpp"

#include <cstdio>
#include <cstdlib>

int main(int argc, char **argv)
try {
    fr_iri_config config = fr_iri_defaults();
    config.interval_m = argc > 1 ? std::atof(argv[1]) : 0.025;
    floatref::iri iri(config);
    std::vector<fr_real> elevation;
    for (double z; std::scanf("%lf", &z) == 1;)
        elevation.push_back(static_cast<fr_real>(z));
    iri.push([&](auto *o, auto *y, auto room, auto *n) {
        return fr_iri_push(o, elevation.data(), elevation.size(), y, room, n);
    });
    iri.push([](auto *o, auto *y, auto room, auto *n) { return fr_iri_finish(o, y, room, n); });
    fr_real m_per_km = 0;
    floatref::check(fr_iri_value(iri.get(), &m_per_km));
    std::printf("IRI %.3f m/km\n", static_cast<double>(m_per_km));
} catch (const floatref::error &error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
}
