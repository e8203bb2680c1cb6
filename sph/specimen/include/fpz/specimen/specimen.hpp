// From a scene to something that runs: particles, groups, gauges bound to particles.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "fpz/specimen/crack.hpp"
#include "fpz/specimen/scene.hpp"
#include "fpz/specimen/vtu.hpp"
#include "fpz/sph/simulation.hpp"

namespace fpz::specimen {

/// A slot as its particles make it, or a cut as it is.
struct SlotOfParticles {
  double width = 0.0;   ///< between the cells of the nearest particles of both sides, m; 0: a cut
  double length = 0.0;  ///< from the mouth to the cell of the first particle beyond the end, m
};

/// Of a notch with a width above 0; the length of an internal one between the cells beyond its ends. NaN where no
/// particle stands beside or beyond it.
[[nodiscard]] SlotOfParticles slot_of_particles(const Notch& notch, const sph::Arrangement<2>& particles,
                                                double spacing);

/// Everything that a run needs besides its output.
struct Specimen {
  sph::RunSetup<2> setup;
  std::map<std::string, BoundGauge> gauges;
  double area = 0.0;                   ///< of the specimen without boundary particles, m^2
  std::vector<SlotOfParticles> slots;  ///< of the notches, in their order
  std::vector<double> loaded_lengths;  ///< of the surface, for each load, m: without what platens cover
  std::vector<std::string> warnings;   ///< doubtful about its particles
};

/// Places the particles and binds the gauges. Throws io::InputError naming the scene when something does not fit.
[[nodiscard]] Specimen make_specimen(const Scene& scene);

/// Particles from a CSV (columns x, y; optional volume, group), .vtu or legacy .vtk file (point data volume, group).
/// Without volumes all have spacing^2. Group -1 is the specimen, others are indices of boundaries.
[[nodiscard]] sph::Arrangement<2> read_particles(const std::filesystem::path& file, double spacing,
                                                 const io::CsvOptions& notation = {});

/// Column (or point data) `material` of such a file, a region's number for each particle, 0 for none; empty when it has
/// no such column.
[[nodiscard]] std::vector<int> read_particle_materials(const std::filesystem::path& file,
                                                       const io::CsvOptions& notation = {});

/// The particles of the specimen for the crack measures (without boundary particles).
[[nodiscard]] std::vector<Spot> spots(const sph::Simulation<2>& run, const Specimen& specimen);
/// tensile_strength delta0 of what has cracked, mean over volume times damage, J/m^2; of the first material where
/// nothing has.
[[nodiscard]] double mean_fracture_energy(const sph::Simulation<2>& run, const Specimen& specimen);
/// Largest jump of a cracked particle, m; NaN without a crack.
[[nodiscard]] double largest_opening(const sph::Simulation<2>& run);

/// All particles with their fields for a VTU file, in the order of the arrangement: group, damage, crack_normal, jump,
/// stress (xx, yy, xy), velocity, displacement, elastic_energy (J/m^3), dissipated_energy (per crack area, J/m^2);
/// material, where there are several; interface (its number from 1 on, 0: none), where there are any.
[[nodiscard]] PointCloud frame_of(const sph::Simulation<2>& run, const Specimen& specimen);

/// Size of the file of such a frame, about.
[[nodiscard]] double frame_bytes(std::size_t particles);

}  // namespace fpz::specimen
