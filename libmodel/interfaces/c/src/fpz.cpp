#include "fpz.h"

#include <cmath>
#include <exception>
#include <limits>
#include <span>
#include <stdexcept>
#include <string>

#include "fpz/point/batch.hpp"
#include "fpz/point/point_update.hpp"

struct fpz_material {
  fpz::point::Behaviour behaviour;
};

namespace {

using namespace fpz;

static_assert(FPZ_THREE_D == static_cast<int>(Setting::three_d) &&
              FPZ_PLANE_STRESS == static_cast<int>(Setting::plane_stress));
static_assert(FPZ_INVALID_INPUT == static_cast<int>(Status::invalid_input) &&
              FPZ_SNAP_BACK == static_cast<int>(Status::snap_back) &&
              FPZ_NON_CONVERGENCE == static_cast<int>(Status::non_convergence) &&
              FPZ_NO_PLASTIC_FLOW == static_cast<int>(Status::no_plastic_flow));

fpz_status code(Status status) { return static_cast<fpz_status>(status); }

/// Runs f, which returns a status; what it throws becomes a message.
template <class F>
fpz_status guarded(const F& f) noexcept {
  try {
    return f();
  } catch (const std::exception& e) {
    point::set_last_message(e.what());
  } catch (...) {
    point::set_last_message("unknown failure");
  }
  return FPZ_INVALID_INPUT;
}

void require(bool holds, const char* what) {
  if (!holds) throw std::invalid_argument(what);
}

Setting known(fpz_setting setting) {
  require(setting == FPZ_PLANE_STRAIN || setting == FPZ_PLANE_STRESS || setting == FPZ_THREE_D,
          "the setting is none of FPZ_PLANE_STRAIN, FPZ_PLANE_STRESS and FPZ_THREE_D");
  return static_cast<Setting>(setting);
}

int dimension(fpz_setting setting) { return setting == FPZ_THREE_D ? 3 : 2; }

const point::Property* property(int k) noexcept {
  const auto& list = point::properties();
  return k >= 0 && k < static_cast<int>(list.size()) ? &list[static_cast<std::size_t>(k)] : nullptr;
}

template <int Dim>
fpz_status update(const fpz_material& m, const double* begin, const double* increment, double* end, double* tangent,
                  double* energies) {
  const point::Outcome out = point::update_flat<Dim>(m.behaviour, begin, increment, end, tangent);
  if (energies != nullptr && out.ok()) {
    energies[0] = out.stored_energy;
    energies[1] = out.dissipated_energy;
  }
  return code(out.status);
}

template <class Number>
point::View<Number> view(const fpz_array& a) {
  return {a.data, a.point, a.component};
}

point::BatchArrays arrays_of(const fpz_batch& b) {
  require(b.begin.data != nullptr && b.strain_increments.data != nullptr && b.end.data != nullptr,
          "fpz_update_batch: begin, strain_increments and end must be given");
  return {b.points,
          view<const double>(b.begin),
          view<const double>(b.strain_increments),
          view<double>(b.end),
          view<double>(b.tangents),
          view<double>(b.energies),
          b.lengths,
          b.statuses};
}

}  // namespace

#pragma GCC visibility push(default)

int fpz_interface_version(void) { return FPZ_INTERFACE_VERSION; }

const char* fpz_version(void) { return FPZ_VERSION; }

const char* fpz_status_word(fpz_status status) {
  for (const Word<Status>& w : Words<Status>::list) {
    if (static_cast<int>(w.value) == status) return w.text;
  }
  return "unknown";
}

const char* fpz_message(void) { return point::last_message().c_str(); }

void fpz_capture_failures(const char* folder) {
  (void)guarded([&] {
    point::set_capture_folder(folder != nullptr ? folder : "");
    return FPZ_OK;
  });
}

int fpz_property_count(void) { return static_cast<int>(point::property_count); }

const char* fpz_property_name(int k) { return property(k) != nullptr ? property(k)->name.c_str() : nullptr; }

const char* fpz_property_unit(int k) { return property(k) != nullptr ? property(k)->unit.c_str() : nullptr; }

const char* fpz_property_values(int k) { return property(k) != nullptr ? property(k)->values.c_str() : nullptr; }

double fpz_property_default(int k) {
  const point::Property* p = property(k);
  return p != nullptr && !p->required ? p->default_value : std::numeric_limits<double>::quiet_NaN();
}

int fpz_tensor_size(fpz_setting setting) { return setting == FPZ_THREE_D ? tensor_size<3> : tensor_size<2>; }

int fpz_state_size(fpz_setting setting) {
  return static_cast<int>(setting == FPZ_THREE_D ? point::state_size<3> : point::state_size<2>);
}

const char* fpz_state_name(fpz_setting setting, int k) {
  const auto& names = point::state_names(dimension(setting));
  return k >= 0 && k < static_cast<int>(names.size()) ? names[static_cast<std::size_t>(k)].c_str() : nullptr;
}

fpz_status fpz_material_new(fpz_setting setting, const double* properties, int count, fpz_material** material) {
  return guarded([&] {
    require(material != nullptr, "fpz_material_new: nowhere to put the material");
    *material = nullptr;
    require(properties != nullptr && count >= 0, "fpz_material_new: no properties");
    const std::span<const double> list(properties, static_cast<std::size_t>(count));
    *material = new fpz_material{point::make_behaviour(known(setting), list)};
    return FPZ_OK;
  });
}

void fpz_material_free(fpz_material* material) { delete material; }

const char* fpz_material_warnings(const fpz_material* m) { return m != nullptr ? m->behaviour.warnings.c_str() : ""; }

double fpz_material_snap_back_length(const fpz_material* m) {
  return m != nullptr ? m->behaviour.snap_back_length : std::numeric_limits<double>::quiet_NaN();
}

fpz_status fpz_material_set_length(fpz_material* m, double rve_length) {
  return guarded([&] {
    require(m != nullptr, "fpz_material_set_length: no material");
    point::Statement s{m->behaviour.parameters, m->behaviour.options};
    s.parameters.rve_length = rve_length;
    m->behaviour = point::make_behaviour(m->behaviour.setting, s);
    return FPZ_OK;
  });
}

fpz_status fpz_update(const fpz_material* m, const double* begin, const double* strain_increment, double* end,
                      double* tangent, double* energies) {
  return guarded([&] {
    require(m != nullptr && begin != nullptr && strain_increment != nullptr && end != nullptr,
            "fpz_update: material, begin, strain_increment and end must be given");
    return m->behaviour.setting == Setting::three_d ? update<3>(*m, begin, strain_increment, end, tangent, energies)
                                                    : update<2>(*m, begin, strain_increment, end, tangent, energies);
  });
}

fpz_status fpz_update_batch(const fpz_material* m, const fpz_batch* batch, fpz_report* report) {
  if (report != nullptr) *report = {};
  return guarded([&] {
    require(m != nullptr && batch != nullptr, "fpz_update_batch: material and batch must be given");
    const point::BatchArrays arrays = arrays_of(*batch);
    const BatchReport r = m->behaviour.setting == Setting::three_d
                              ? point::update_batch<3>(m->behaviour, arrays, batch->threads)
                              : point::update_batch<2>(m->behaviour, arrays, batch->threads);
    if (report != nullptr) *report = {r.failed, r.first_failed, r.cracked, r.new_cracks, r.iterations};
    return code(r.first_status);
  });
}

#pragma GCC visibility pop
