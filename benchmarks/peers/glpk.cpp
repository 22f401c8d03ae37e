// GLPK's out-of-kilter flows, the faster one up to about 200x20, and its dual simplex on the same problem as an LP.
// Set-up is filling its graph or LP. Solving is the call: the simplex starts from Bixby's basis, made anew each time,
// with projected steepest edges and the plain ratio test (of 19 combinations the fastest). GLPK's RELAX-IV would be a
// rival, but is disabled since version 5.

#include "network.hpp"

#include <glpk.h>

#include <array>
#include <cstddef>

namespace peers {
namespace {

class glpk_out_of_kilter : public peer {
public:
  explicit glpk_out_of_kilter(additive_instance const& in) : agents_(in.agents), net_(in) {
    glp_add_vertices(graph_.get(), static_cast<int>(net_.supply.size()));
    for (std::size_t v = 0; v < net_.supply.size(); ++v) *static_cast<double*>(graph_->v[v + 1]->data) = net_.supply[v];
    for (auto const& arc : net_.arcs) {
      arcs_.push_back(glp_add_arc(graph_.get(), arc.from + 1, arc.to + 1));
      *static_cast<arc_data*>(arcs_.back()->data) = {0, static_cast<double>(arc.capacity),
                                                     static_cast<double>(arc.cost), 0};
    }
  }

  bool solve() override {
    double cost = 0;
    return glp_mincost_okalg(graph_.get(), 0, offsetof(arc_data, lower), offsetof(arc_data, capacity),
                             offsetof(arc_data, cost), &cost, offsetof(arc_data, flow), -1) == 0;
  }

  assignment answer() const override {
    return net_.read(agents_, [&](std::size_t e) { return static_cast<arc_data const*>(arcs_[e]->data)->flow > 0.5; });
  }

private:
  struct arc_data {
    double lower;
    double capacity;
    double cost;
    double flow;
  };
  struct deleter {
    void operator()(glp_graph* g) const { glp_delete_graph(g); }
  };

  std::size_t agents_;
  network net_;
  std::unique_ptr<glp_graph, deleter> graph_{glp_create_graph(sizeof(double), sizeof(arc_data))};
  std::vector<glp_arc*> arcs_;
};

class glpk_dual_simplex : public peer {
public:
  explicit glpk_dual_simplex(additive_instance const& in) : agents_(in.agents), net_(in) {
    auto const n = static_cast<int>(in.agents);
    glp_add_rows(lp_.get(), n + static_cast<int>(in.slots()));
    for (int a = 1; a <= n; ++a) glp_set_row_bnds(lp_.get(), a, GLP_FX, 1, 1);
    for (std::size_t s = 0; s < in.slots(); ++s) {
      auto const kind = in.bounds.lower[s] == in.bounds.upper[s] ? GLP_FX : GLP_DB;
      glp_set_row_bnds(lp_.get(), n + 1 + static_cast<int>(s), kind, in.bounds.lower[s], in.bounds.upper[s]);
    }
    std::array<double, 3> const ones{0, 1, 1};
    glp_add_cols(lp_.get(), static_cast<int>(net_.pairs));
    for (int e = 1; e <= static_cast<int>(net_.pairs); ++e) {
      auto const& arc = net_.arcs[static_cast<std::size_t>(e) - 1];
      std::array<int, 3> const rows{0, arc.from + 1, arc.to + 1};
      glp_set_col_bnds(lp_.get(), e, GLP_LO, 0, 0);
      glp_set_obj_coef(lp_.get(), e, static_cast<double>(arc.cost));
      glp_set_mat_col(lp_.get(), e, 2, rows.data(), ones.data());
    }
    glp_init_smcp(&options_);
    options_.msg_lev = GLP_MSG_OFF;
    options_.meth = GLP_DUALP;  // primal where the dual gives up
    options_.pricing = GLP_PT_PSE;
    options_.r_test = GLP_RT_STD;
  }

  bool solve() override {
    glp_cpx_basis(lp_.get());
    return glp_simplex(lp_.get(), &options_) == 0 && glp_get_status(lp_.get()) == GLP_OPT;
  }

  assignment answer() const override {
    return net_.read(agents_,
                     [&](std::size_t e) { return glp_get_col_prim(lp_.get(), static_cast<int>(e) + 1) > 0.5; });
  }

private:
  struct deleter {
    void operator()(glp_prob* p) const { glp_delete_prob(p); }
  };
  static glp_prob* silent_problem() {
    glp_term_out(GLP_OFF);
    return glp_create_prob();
  }

  std::size_t agents_;
  network net_;
  std::unique_ptr<glp_prob, deleter> lp_{silent_problem()};
  glp_smcp options_{};
};

effort of_simplex(additive_instance const& in) {
  auto const pairs = in.utility.size();
  return pairs <= 10'000 ? effort::quick : pairs <= 100'000 ? effort::slow : effort::never;
}
[[maybe_unused]] bool const added = add<glpk_out_of_kilter>("glpk_out_of_kilter", of_simplex) &&
                                    add<glpk_dual_simplex>("glpk_dual_simplex", of_simplex);

}  // namespace
}  // namespace peers
