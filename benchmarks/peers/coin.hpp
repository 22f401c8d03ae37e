#pragma once

#include <coin/Cbc_C_Interface.h>

#include <memory>
#include <utility>
#include <vector>

namespace peers {

/// A linear program of least cost for CBC, column by column.
class coin_program {
public:
  static constexpr double infinite = 1e30;

  int add_row(double lower, double upper) {
    row_lower_.push_back(lower);
    row_upper_.push_back(upper);
    return static_cast<int>(row_lower_.size()) - 1;
  }
  int add_column(double cost, double lower, double upper) {
    cost_.push_back(cost);
    lower_.push_back(lower);
    upper_.push_back(upper);
    entries_.emplace_back();
    return static_cast<int>(cost_.size()) - 1;
  }
  void set(int row, int column, double value) { entries_[static_cast<std::size_t>(column)].emplace_back(row, value); }
  void make_integer(int column) { integers_.push_back(column); }

  /// Hands it over. Nothing may be added afterwards.
  void load() {
    std::vector<int> starts{0};
    std::vector<int> rows;
    std::vector<double> values;
    for (auto const& column : entries_) {
      for (auto const& [row, value] : column) {
        rows.push_back(row);
        values.push_back(value);
      }
      starts.push_back(static_cast<int>(rows.size()));
    }
    original_.reset(Cbc_newModel());
    Cbc_loadProblem(original_.get(), static_cast<int>(cost_.size()), static_cast<int>(row_lower_.size()), starts.data(),
                    rows.data(), values.data(), lower_.data(), upper_.data(), cost_.data(), row_lower_.data(),
                    row_upper_.data());
    for (int const column : integers_) Cbc_setInteger(original_.get(), column);
    rewind();
  }

  /// Forgets what the last call of `solve` found, since CBC would start from there.
  void rewind() {
    model_.reset(Cbc_clone(original_.get()));
    Cbc_setLogLevel(model_.get(), 0);
    for (char const* option : {"preprocess", "presolve", "cuts", "heuristics"})
      Cbc_setParameter(model_.get(), option, "off");
    Cbc_setParameter(model_.get(), "ratioGap", "0");
    Cbc_setParameter(model_.get(), "allowableGap", "0.5");  // costs are integers
  }

  bool solve() {
    Cbc_solve(model_.get());
    return Cbc_isProvenOptimal(model_.get()) != 0;
  }
  /// Of the last solution.
  double value(int column) const { return Cbc_getColSolution(model_.get())[column]; }

private:
  struct deleter {
    void operator()(Cbc_Model* m) const { Cbc_deleteModel(m); }
  };
  using model = std::unique_ptr<Cbc_Model, deleter>;

  std::vector<double> row_lower_;
  std::vector<double> row_upper_;
  std::vector<double> cost_;
  std::vector<double> lower_;
  std::vector<double> upper_;
  std::vector<std::vector<std::pair<int, double>>> entries_;
  std::vector<int> integers_;
  model original_;
  model model_;
};

}  // namespace peers
