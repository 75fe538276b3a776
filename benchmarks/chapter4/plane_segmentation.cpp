// SPDX-License-Identifier: BSL-1.0
#include <chrono>
#include <cstdio>
#include <cstring>
#include <string>
#include <vector>

#include "hoover.hpp"
#include "plane_methods.hpp"
#include "plane_scans.hpp"

using namespace planes;
int main(int argc, char** argv) {
    std::string which = argc > 1 ? argv[1] : "st", who = argc > 2 ? argv[2] : "gpc";
    bool grid = argc > 3 && argv[3][0] == 'g';
    bool verbose = argc > 4;
    std::vector<cloud> clouds;
    const std::string d = "/work/shared/data/segmentation_truth/";
    if (which.find('s') != std::string::npos)
        clouds.push_back(read_labelled("synpeb", d + "synpeb_test_100.pcd", "intensity", 10));
    if (which.find('t') != std::string::npos)
        clouds.push_back(read_labelled("tum", d + "tum_office_room1_parts.pcd", "label", 1));
    if (which.find('b') != std::string::npos)
        for (int s = 1; s <= 3; ++s) {
            clouds.push_back(blocks(s, 100, 0.001));
            clouds.push_back(blocks(s + 10, 200, 0.005));
        }
    if (which.find('f') != std::string::npos)
        for (int s = 1; s <= 3; ++s) clouds.push_back(furniture(s, 0.003));
    std::vector<method> ms;
    auto add = [&](std::vector<method> m) {
        for (auto& x : m) ms.push_back(x);
    };
    if (who.find('g') != std::string::npos) add(gnomon_methods());
#ifdef PEERS
    if (who.find('p') != std::string::npos) add(pcl_methods());
    if (who.find('c') != std::string::npos) add(cgal_methods());
#endif
    for (auto& c : clouds) {
        printf("== %s n=%zu noise %.5f spacing %.5f\n", c.name.c_str(), c.points.size(), c.noise,
               c.spacing);
        for (auto& m : ms) {
            double best = -1;
            std::string bl;
            for (size_t s = 0; s < m.settings.size(); ++s) {
                if (s && !grid) break;
                auto t0 = std::chrono::steady_clock::now();
                auto l = m.settings[s].segment(c);
                double dt =
                    std::chrono::duration<double>(std::chrono::steady_clock::now() - t0).count();
                hoover::overlaps o(c.truth, l);
                auto k = o.at(.8);
                char line[400];
                snprintf(line, 400,
                         "%-22s %-40s cor %3zu/%zu=%.3f over %zu under %zu missed %zu noise %zu "
                         "seg %zu F %.3f  %.1fs [51: %zu 95: %zu]",
                         m.name.c_str(), m.settings[s].name.c_str(), k.correct, k.regions,
                         k.correct_fraction(), k.over, k.under, k.missed, k.noise, k.segments,
                         k.f(), dt, o.at(.51).correct, o.at(.95).correct);
                if (s == 0 || verbose) puts(line);
                double q = k.correct_fraction() + 1e-3 * k.f();
                if (q > best) {
                    best = q;
                    bl = line;
                }
            }
            if (grid) printf("BEST %s\n", bl.c_str());
            fflush(stdout);
        }
    }
}
