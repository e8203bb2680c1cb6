#include "fpz/sph/linear_fit.hpp"

#include <algorithm>

namespace fpz::sph {

LinearFit::LinearFit(const std::vector<Vec<double, 2>>& seen, const std::vector<double>& volume) {
  Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
  for (std::size_t k = 0; k < seen.size(); ++k) {
    const double bell = std::max(0.0, 1.0 - seen[k].squaredNorm());
    const Eigen::Vector3d place(1.0, seen[k][0], seen[k][1]);
    terms_.emplace_back(bell * bell * volume[k] * place);
    moments += terms_.back() * place.transpose();
  }
  factors_.setThreshold(1e-9);
  factors_.compute(moments);
  determined_ = seen.size() >= 3 && factors_.isInvertible();
}

std::vector<double> LinearFit::weights(const Eigen::Vector3d& sums) const {
  const Eigen::Vector3d constants = factors_.solve(sums);
  std::vector<double> all;
  for (const Eigen::Vector3d& term : terms_) all.push_back(term.dot(constants));
  return all;
}

}  // namespace fpz::sph
