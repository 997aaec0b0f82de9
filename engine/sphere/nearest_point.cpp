#include "sphere/nearest_point.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace shoal {
namespace {

using Real = long double;
using Vector = std::vector<Real>;

// Dual feasibility, for columns and a residual of length at most 1.
constexpr Real kOptimal = 1e-15L;

Real dot(const Vector& a, const Vector& b) {
  Real sum = 0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += a[k] * b[k];
  return sum;
}

// a += factor b
void add(Vector& a, Real factor, const Vector& b) {
  for (std::size_t k = 0; k < a.size(); ++k) a[k] += factor * b[k];
}

// The u that minimises |sum u_j columns[j] - target|, by Gram-Schmidt done twice, which keeps the
// directions orthogonal to rounding ("twice is enough", Giraud, Langou, Rozloznik, "The loss of
// orthogonality in the Gram-Schmidt orthogonalization process", Comput. Math. Appl. 50 (2005)).
Vector least_squares(const std::vector<const Vector*>& columns, const Vector& target) {
  const std::size_t count = columns.size();
  std::vector<Vector> directions;
  std::vector<Vector> upper(count, Vector(count, 0));  // columns[j] = sum_k upper[k][j] dir_k
  for (std::size_t j = 0; j < count; ++j) {
    Vector rest = *columns[j];
    for (int pass = 0; pass < 2; ++pass) {
      for (std::size_t k = 0; k < j; ++k) {
        const Real along = dot(directions[k], rest);
        upper[k][j] += along;
        add(rest, -along, directions[k]);
      }
    }
    upper[j][j] = std::sqrt(dot(rest, rest));
    for (Real& value : rest) value /= upper[j][j];
    directions.push_back(std::move(rest));
  }
  Vector u(count);
  for (std::size_t j = count; j-- > 0;) {
    Real sum = dot(directions[j], target);
    for (std::size_t k = j + 1; k < count; ++k) sum -= upper[j][k] * u[k];
    u[j] = sum / upper[j][j];
  }
  return u;
}

// Non-negative least squares: the u >= 0 that minimises |sum u_j columns[j] - target|.
class NonNegativeLeastSquares {
 public:
  NonNegativeLeastSquares(const std::vector<Vector>& columns, const Vector& target)
      : columns_(columns), target_(target), u_(columns.size(), 0) {}

  // target - sum u_j columns[j] at the minimum, or nothing if the search does not settle.
  std::optional<Vector> residual() {
    Vector rest = target_;
    for (std::size_t round = 0; round < 10 * columns_.size() + 10; ++round) {
      const std::size_t entering = most_helpful(rest);
      if (entering == columns_.size()) return rest;
      passive_.push_back(entering);
      if (!settle_passive()) return rest;
      rest = target_;
      for (std::size_t j : passive_) add(rest, -u_[j], columns_[j]);
    }
    return std::nullopt;
  }

 private:
  // The column at rest along which the residual falls fastest; their count where none is left.
  std::size_t most_helpful(const Vector& rest) const {
    std::size_t best = columns_.size();
    Real steepest = kOptimal;
    for (std::size_t j = 0; j < columns_.size(); ++j) {
      if (std::find(passive_.begin(), passive_.end(), j) != passive_.end()) continue;
      if (const Real slope = dot(columns_[j], rest); slope > steepest) {
        steepest = slope;
        best = j;
      }
    }
    return best;
  }

  // Moves to the least-squares solution on the passive columns, sending those back that would turn
  // negative on the way. False where rounding gives the entering column nothing: no better can be
  // had.
  bool settle_passive() {
    const std::size_t entering = passive_.back();
    while (true) {
      std::vector<const Vector*> chosen;
      for (std::size_t j : passive_) chosen.push_back(&columns_[j]);
      const Vector wanted = least_squares(chosen, target_);
      if (u_[entering] == 0 && !(wanted.back() > 0) && passive_.back() == entering) {
        passive_.pop_back();
        return false;
      }
      Real part = 1;
      std::size_t blocking = passive_.size();
      for (std::size_t k = 0; k < passive_.size(); ++k) {
        if (wanted[k] > 0) continue;
        const Real from = u_[passive_[k]];
        const Real reach = from > 0 ? from / (from - wanted[k]) : 0;
        if (blocking == passive_.size() || reach < part) {
          part = reach;
          blocking = k;
        }
      }
      for (std::size_t k = 0; k < passive_.size(); ++k) {
        Real& value = u_[passive_[k]];
        value = std::max(Real(0), value + part * (wanted[k] - value));
      }
      if (blocking == passive_.size()) return true;
      u_[passive_[blocking]] = 0;
      std::erase_if(passive_, [&](std::size_t j) { return u_[j] == 0; });
    }
  }

  const std::vector<Vector>& columns_;
  const Vector& target_;
  Vector u_;
  std::vector<std::size_t> passive_;  // columns that take part, in the order they came
};

}  // namespace

std::optional<std::vector<double>> nearest_point(int dimension,
                                                 std::span<const HalfSpace> conditions) {
  // Columns (normal, bound), of unit length: a condition times a positive number is the same.
  std::vector<Vector> columns;
  for (const HalfSpace& condition : conditions) {
    Vector column(condition.normal.begin(), condition.normal.end());
    column.push_back(condition.bound);
    const Real length = std::sqrt(dot(column, column));
    if (length == 0) continue;
    for (Real& value : column) value /= length;
    columns.push_back(std::move(column));
  }
  Vector target(dimension + 1, 0);
  target.back() = 1;

  const std::optional<Vector> rest = NonNegativeLeastSquares(columns, target).residual();
  if (!rest) return std::nullopt;
  // The residual's last component is its square length, 1 / (1 + |x|^2); zero where the conditions
  // contradict each other.
  if (!(rest->back() > 1e-12L)) return std::nullopt;
  std::vector<double> x(dimension);
  for (int k = 0; k < dimension; ++k) x[k] = static_cast<double>(-(*rest)[k] / rest->back());
  return x;
}

}  // namespace shoal
