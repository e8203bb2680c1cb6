#include "material_map.hpp"

#include <algorithm>
#include <stdexcept>

#include "fpz/io/problems.hpp"
#include "fpz/specimen/specimen.hpp"

namespace fpz::specimen::detail {
namespace {

using Arrangement = sph::Arrangement<2>;

/// The last region that covers x, or their number.
std::size_t region_at(const Scene& scene, const Point& x) {
  for (std::size_t k = scene.regions.size(); k-- > 0;) {
    const std::vector<Shape>& shapes = scene.regions[k].shapes;
    if (std::any_of(shapes.begin(), shapes.end(), [&](const Shape& s) { return contains(s, x); })) return k;
  }
  return scene.regions.size();
}

/// Regions of the particles of a file: its column "material" says 0 for none, else 1 for the first, ...
std::vector<int> regions_of_file(const Scene& scene) {
  const std::string file = scene.particles->file.string();
  std::vector<int> regions = read_particle_materials(scene.particles->file, scene.particles->notation);
  const auto known = [&](int k) { return k >= 0 && static_cast<std::size_t>(k) <= scene.regions.size(); };
  const auto wrong = std::find_if_not(regions.begin(), regions.end(), known);
  if (wrong != regions.end()) {
    throw std::invalid_argument(file + ": particle " + std::to_string(wrong - regions.begin()) + ": its material " +
                                std::to_string(*wrong) + " is none: must be 0, or the number of an entry of " +
                                "\"regions\", of which there are " + std::to_string(scene.regions.size()));
  }
  return regions;
}

void require_particles(const Scene& scene, const std::vector<int>& regions) {
  for (std::size_t k = 0; k < scene.regions.size(); ++k) {
    if (std::find(regions.begin(), regions.end(), static_cast<int>(k) + 1) != regions.end()) continue;
    throw std::invalid_argument("regions[" + std::to_string(k) + "] = " + io::in_quotes(scene.regions[k].name) +
                                ": no particle is in it" +
                                (scene.regions[k].shapes.empty() ? ", and it has no \"shape\""
                                                                 : "; a smaller \"spacing\" may help, or later "
                                                                   "regions cover it"));
  }
}

}  // namespace

std::size_t material_at(const Scene& scene, const Point& x) {
  const std::size_t k = region_at(scene, x);
  return k < scene.regions.size() ? scene.regions[k].material : 0;
}

const Parameters& parameters_at(const Scene& scene, const Point& x) {
  const std::size_t k = material_at(scene, x);
  return k == 0 ? scene.parameters : scene.further_materials[k - 1].parameters;
}

void assign_materials(const Scene& scene, sph::RunSetup<2>& setup) {
  if (scene.further_materials.empty()) return;
  const Arrangement& a = setup.arrangement;
  std::vector<int> regions = scene.particles ? regions_of_file(scene) : std::vector<int>();
  regions.resize(a.size(), 0);
  sph::Materials& materials = setup.materials;
  for (const SceneMaterial& m : scene.further_materials) materials.further.push_back(m.parameters);
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a.group[i] != Arrangement::specimen) {
      materials.of_particle.push_back(
          static_cast<int>(scene.boundaries[static_cast<std::size_t>(a.group[i])].material));
      continue;
    }
    const std::size_t k = region_at(scene, a.position[i]);
    if (k < scene.regions.size()) regions[i] = static_cast<int>(k) + 1;
    materials.of_particle.push_back(
        regions[i] == 0 ? 0 : static_cast<int>(scene.regions[static_cast<std::size_t>(regions[i]) - 1].material));
  }
  require_particles(scene, regions);
}

std::vector<MaterialShare> material_shares(const Scene& scene, const sph::RunSetup<2>& setup) {
  std::vector<MaterialShare> shares = {{scene.material_name, &scene.parameters}};
  for (const SceneMaterial& m : scene.further_materials) shares.push_back({m.name, &m.parameters});
  for (std::size_t i = 0; i < setup.arrangement.size(); ++i) {
    MaterialShare& share = shares[setup.materials.of(i)];
    ++share.particles;
    share.area += setup.arrangement.volume[i];
  }
  return shares;
}

}  // namespace fpz::specimen::detail
