// What the set-up of the bonds' vectors costs with several sparse solvers.
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCholesky>
#include <array>
#include <ctime>
#include <functional>
#include <stdexcept>
#ifdef FPZ_WITH_CHOLMOD
#include <Eigen/CholmodSupport>
#endif

#include "bond_vectors.hpp"
#include "patch_setup.hpp"
#include "patch_trials.hpp"

namespace fpz::report {
namespace {

using specimen::Point;
using sph::detail::multipliers;
using Sparse = Eigen::SparseMatrix<double>;
using Ordering = Eigen::PermutationMatrix<Eigen::Dynamic>;

double processor_seconds() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

double peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;  // MiB
}

/// Seconds, memory, entries, residual: what comes back from a process.
using Figures = std::array<double, 4>;

/// Runs work() in a process of its own, so that peaks of memory do not mix. False when it did not end well. To be
/// called before the first parallel loop of this process: a fork has not its threads.
bool in_own_process(const std::function<Figures()>& work, Figures& figures) {
  int ends[2];
  if (pipe(ends) != 0) return false;
  const pid_t child = fork();
  if (child == 0) {
    close(ends[0]);
    bool sent = false;
    try {
      const Figures own = work();
      sent = write(ends[1], own.data(), sizeof own) == static_cast<ssize_t>(sizeof own);
    } catch (const std::exception&) {
    }
    _exit(sent ? 0 : 1);
  }
  close(ends[1]);
  const bool received =
      child > 0 && read(ends[0], figures.data(), sizeof figures) == static_cast<ssize_t>(sizeof figures);
  close(ends[0]);
  int status = 0;
  return child > 0 && waitpid(child, &status, 0) == child && status == 0 && received;
}

/// 2 rows x rows particles.
sph::RunSetup<2> strip(const specimen::Pattern& pattern, int rows) {
  specimen::Body body;
  body.shape = specimen::Rectangle{Point(-1.0, -0.5), Point(1.0, 0.5)};
  return patch_setup(body, pattern, 1.0 / rows);
}

struct Problem {
  sph::detail::RunData<2> run;
  sph::detail::NeighbourLists lists;
  sph::detail::NormalEquations equations;

  explicit Problem(const sph::RunSetup<2>& setup)
      : run(setup, 1.0),
        lists(sph::detail::find_neighbours<2>(run.team, run.particles.start, run.particles.count,
                                              sph::kernel_support * run.h)),
        equations(sph::detail::normal_equations(run, lists)) {}
};

/// Lower triangle.
Sparse sparse(const sph::detail::BlockMatrix<multipliers>& m) {
  std::vector<Eigen::Triplet<double>> entries;
  const auto add = [&entries](int row, int column, const auto& block) {
    for (int c = 0; c < multipliers; ++c) {
      for (int r = row == column ? c : 0; r < multipliers; ++r) {
        if (block(r, c) != 0.0) entries.emplace_back(multipliers * row + r, multipliers * column + c, block(r, c));
      }
    }
  };
  for (std::size_t i = 0; i < m.diagonal.size(); ++i) {
    add(static_cast<int>(i), static_cast<int>(i), m.diagonal[i]);
    for (const auto& entry : m.row[i]) add(static_cast<int>(i), entry.column, entry.block);
  }
  const auto size = static_cast<Eigen::Index>(multipliers) * static_cast<Eigen::Index>(m.diagonal.size());
  Sparse all(size, size);
  all.setFromTriplets(entries.begin(), entries.end());
  return all;
}

/// Solution, and how many numbers the solver keeps.
struct Solution {
  Eigen::VectorXd x;
  double entries = 0.0;
};

using Solve = std::function<Solution(const Problem&, const Sparse&)>;

Solution by_blocks(const Problem& p, const Sparse&) {
  const sph::detail::BlockCholesky<multipliers> factors(p.equations.matrix, p.equations.order);
  return {factors.solve(p.equations.right), static_cast<double>(factors.entries())};
}

Solution by_ldlt(const Problem& p, const Sparse& a) {
  const Eigen::SimplicialLDLT<Sparse> factors(a);
  return {factors.solve(p.equations.right), static_cast<double>(factors.matrixL().nestedExpression().nonZeros())};
}

Solution by_dissected_ldlt(const Problem& p, const Sparse& a) {
  const std::vector<int>& order = p.equations.order;
  Ordering place(a.rows());
  for (std::size_t k = 0; k < order.size(); ++k) {
    for (int c = 0; c < multipliers; ++c) {
      place.indices()[multipliers * order[k] + c] = multipliers * static_cast<int>(k) + c;
    }
  }
  Sparse turned(a.rows(), a.cols());
  turned.selfadjointView<Eigen::Lower>() = a.selfadjointView<Eigen::Lower>().twistedBy(place);
  const Eigen::SimplicialLDLT<Sparse, Eigen::Lower, Eigen::NaturalOrdering<int>> factors(turned);
  const Eigen::VectorXd right = place * p.equations.right;
  return {place.transpose() * Eigen::VectorXd(factors.solve(right)),
          static_cast<double>(factors.matrixL().nestedExpression().nonZeros())};
}

#ifdef FPZ_WITH_CHOLMOD
Solution by_cholmod(const Problem& p, const Sparse& a) {
  Eigen::CholmodSupernodalLLT<Sparse> factors;
  factors.compute(a);
  return {factors.solve(p.equations.right), factors.cholmod().lnz};
}
#endif

Solution by_conjugate_gradients(const Problem& p, const Sparse& a) {
  Eigen::ConjugateGradient<Sparse, Eigen::Lower, Eigen::IncompleteCholesky<double>> iteration;
  iteration.setMaxIterations(1000);
  iteration.setTolerance(1e-10);
  iteration.compute(a);
  Solution s;
  s.x = iteration.solve(p.equations.right);
  s.entries = static_cast<double>(iteration.preconditioner().matrixL().nonZeros());
  return s;
}

struct NamedSolver {
  const char* name;
  Solve solve;
};

std::vector<NamedSolver> solvers(bool all) {
  std::vector<NamedSolver> list = {{"blocks of six, nested dissection (chosen)", by_blocks}};
#ifdef FPZ_WITH_CHOLMOD
  list.push_back({"SuiteSparse CHOLMOD, supernodal, approximate minimum degree", by_cholmod});
#endif
  if (!all) return list;
  list.push_back({"Eigen SimplicialLDLT, nested dissection", by_dissected_ldlt});
  list.push_back({"Eigen SimplicialLDLT, approximate minimum degree", by_ldlt});
  list.push_back({"Eigen conjugate gradients, incomplete Cholesky, 1000 iterations at most", by_conjugate_gradients});
  return list;
}

}  // namespace

std::vector<SolverCost> solver_costs(const NamedPattern& pattern, int rows, bool all_solvers) {
  const sph::RunSetup<2> setup = strip(pattern.pattern, rows);
  std::vector<SolverCost> costs;
  for (const NamedSolver& solver : solvers(all_solvers)) {
    Figures f{};
    const bool solved = in_own_process(
        [&] {
          const Problem problem(setup);
          const bool own_matrix = std::string(solver.name).find("blocks") != std::string::npos;
          const Sparse a = own_matrix ? Sparse() : sparse(problem.equations.matrix);
          const double memory = peak_memory(), begin = processor_seconds();
          const Solution s = solver.solve(problem, a);
          const double seconds = processor_seconds() - begin, more = peak_memory() - memory;
          const Sparse check = sparse(problem.equations.matrix);
          const Eigen::VectorXd rest = check.selfadjointView<Eigen::Lower>() * s.x - problem.equations.right;
          return Figures{seconds, more, s.entries, rest.norm() / problem.equations.right.norm()};
        },
        f);
    costs.push_back({solver.name, setup.arrangement.size(), f[0], f[1], f[2], f[3], solved});
  }
  return costs;
}

SolverCost setup_cost(const NamedPattern& pattern, int rows, sph::Gradient gradient) {
  sph::RunSetup<2> setup = strip(pattern.pattern, rows);
  setup.options.gradient = gradient;
  Figures f{};
  const bool solved = in_own_process(
      [&] {
        const double memory = peak_memory(), begin = processor_seconds();
        const sph::Simulation<2> run(setup);
        return Figures{processor_seconds() - begin, peak_memory() - memory, 0.0, 0.0};
      },
      f);
  return {"whole set-up", setup.arrangement.size(), f[0], f[1], 0.0, 0.0, solved};
}

}  // namespace fpz::report
