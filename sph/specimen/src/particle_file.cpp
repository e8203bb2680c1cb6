#include <cmath>

#include "fpz/io/csv.hpp"
#include "fpz/specimen/specimen.hpp"

namespace fpz::specimen {
namespace {

using io::InputError;

sph::Arrangement<2> assemble(const std::vector<double>& x, const std::vector<double>& y,
                             const std::vector<double>* volume, const std::vector<double>* group, double spacing,
                             const std::string& file) {
  sph::Arrangement<2> a;
  a.spacing = spacing;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double v = volume != nullptr ? (*volume)[i] : spacing * spacing;
    const double g = group != nullptr ? (*group)[i] : -1.0;
    const std::string who = file + ": particle " + std::to_string(i) + ": ";
    if (!std::isfinite(x[i]) || !std::isfinite(y[i])) throw InputError(who + "its position is no number");
    if (!(v > 0.0) || !std::isfinite(v)) throw InputError(who + "its volume is not positive");
    if (g != std::floor(g) || g < -1.0 || g > 1e6)
      throw InputError(who + "its group is not -1 or the index of a boundary");
    a.add(Point(x[i], y[i]), v, static_cast<int>(g));
  }
  return a;
}

}  // namespace

sph::Arrangement<2> read_particles(const std::filesystem::path& file, double spacing, const io::CsvOptions& notation) {
  if (file.extension() == ".csv") {
    const io::Table t = io::read_csv(file, notation);
    return assemble(t.at("x"), t.at("y"), t.find("volume"), t.find("group"), spacing, file.string());
  }
  if (file.extension() != ".vtu" && file.extension() != ".vtk") {
    throw InputError(file.string() + ": particles are read from .csv, .vtu and .vtk files");
  }
  const PointCloud cloud = read_vtk(file);
  std::vector<double> x, y;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    x.push_back(cloud.points[3 * i]);
    y.push_back(cloud.points[3 * i + 1]);
  }
  const auto scalars = [&](const char* name) {
    const PointData* d = cloud.find(name);
    return d != nullptr && d->components == 1 ? &d->values : nullptr;
  };
  return assemble(x, y, scalars("volume"), scalars("group"), spacing, file.string());
}

std::vector<int> read_particle_materials(const std::filesystem::path& file, const io::CsvOptions& notation) {
  std::vector<double> numbers;
  if (file.extension() == ".csv") {
    const io::Table t = io::read_csv(file, notation);
    if (const std::vector<double>* column = t.find("material")) numbers = *column;
  } else {
    const PointCloud cloud = read_vtk(file);
    const PointData* d = cloud.find("material");
    if (d != nullptr && d->components == 1) numbers = d->values;
  }
  std::vector<int> materials;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const double m = numbers[i];
    if (!(m >= 0.0 && m < 1e6) || m != std::floor(m)) {
      throw InputError(file.string() + ": particle " + std::to_string(i) +
                       ": its material is no number of a region (0: none of them)");
    }
    materials.push_back(static_cast<int>(m));
  }
  return materials;
}

}  // namespace fpz::specimen
