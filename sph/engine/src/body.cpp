#include "body.hpp"

#include "reference_body.hpp"
#include "updated_body.hpp"

namespace fpz::sph::detail {

template <int Dim>
void Body<Dim>::point_bonds() {
  run_.view.bonds = bonds_.view();
}

template <int Dim>
void Body<Dim>::force(const View<Dim>& view) {
  run_.for_chunks([&](Index first, Index last) {
    if (!sweep_.in_one()) return force_pass_(view, first, last);
    sweep_.finish(first / run_.chunk_blocks, [&](Index from, Index to) { force_pass_(view, from, to); });
  });
}

template <int Dim>
std::unique_ptr<Body<Dim>> make_body(RunData<Dim>& run) {
  if (run.setup.options.configuration == Configuration::updated) return std::make_unique<UpdatedBody<Dim>>(run);
  return std::make_unique<ReferenceBody<Dim>>(run);
}

template void Body<2>::point_bonds();
template void Body<2>::force(const View<2>&);
template std::unique_ptr<Body<2>> make_body<2>(RunData<2>&);

}  // namespace fpz::sph::detail
