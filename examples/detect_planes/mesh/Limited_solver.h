// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// GLPK for CGAL::Polygonal_surface_reconstruction, with an end: CGAL's own class passes neither a limit nor a callback.

#ifndef DETECT_PLANES_LIMITED_SOLVER_H
#define DETECT_PLANES_LIMITED_SOLVER_H

#include "signals.h"

#include <CGAL/GLPK_mixed_integer_program_traits.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <memory>
#include <string>
#include <vector>

namespace program {

// A program of binary variables.
class Limited_solver : public CGAL::GLPK_mixed_integer_program_traits<double> {
public:
  // Of all solvers: CGAL constructs the one that it uses, so that nothing can be passed in or asked of it.
  inline static int seconds = 60; // of processor time
  inline static bool is_out_of_time = false;

  bool solve() override
  {
    const std::unique_ptr<glp_prob, decltype(&glp_delete_prob)> problem(glp_create_prob(), &glp_delete_prob);
    add_variables(*problem);
    add_constraints(*problem);
    glp_iocp settings;
    glp_init_iocp(&settings);
    settings.msg_lev = GLP_MSG_OFF;
    settings.presolve = GLP_ON;
    settings.tm_lim = longest_wait();
    is_out_of_time = false;
    std::clock_t end = std::clock() + std::clock_t(seconds) * CLOCKS_PER_SEC;
    settings.cb_info = &end;
    settings.cb_func = [](glp_tree* tree, void* end) {
      is_out_of_time = std::clock() > *static_cast<const std::clock_t*>(end);
      if(is_interrupted() || is_out_of_time)
        glp_ios_terminate(tree);
    };
    const int status = glp_intopt(problem.get(), &settings);
    if(is_interrupted())
      throw Interrupted();
    is_out_of_time = is_out_of_time || status == GLP_ETMLIM;
    error_message_ = "status " + std::to_string(status) + " of GLPK";
    if(status != 0 || glp_mip_status(problem.get()) != GLP_OPT)
      return false;
    result_.clear();
    for(Variable* v : variables_) {
      result_.push_back(std::round(glp_mip_col_val(problem.get(), column(*v))));
      v->set_solution_value(result_.back());
    }
    return true;
  }

private:
  // In milliseconds. GLPK looks at another clock, and calls back in the search only, not in what goes before it. So on
  // a machine that has much else to do, this is the end.
  static int longest_wait() { return int((std::min)(10 * 1000LL * seconds, 2000000000LL)); }

  static int column(const Variable& v) { return int(v.index()) + 1; } // GLPK counts from 1

  void add_variables(glp_prob& problem) const
  {
    glp_add_cols(&problem, int(variables_.size()));
    for(const Variable* v : variables_)
      glp_set_col_kind(&problem, column(*v), GLP_BV);
    for(const auto& [v, coefficient] : objective_->coefficients())
      glp_set_obj_coef(&problem, column(*v), coefficient);
  }

  void add_constraints(glp_prob& problem) const
  {
    glp_add_rows(&problem, int(constraints_.size()));
    for(std::size_t i = 0; i < constraints_.size(); ++i) {
      std::vector<int> columns(1, 0);
      std::vector<double> coefficients(1, 0);
      for(const auto& [v, coefficient] : constraints_[i]->coefficients()) {
        columns.push_back(column(*v));
        coefficients.push_back(coefficient);
      }
      const int row = int(i) + 1;
      glp_set_mat_row(&problem, row, int(columns.size()) - 1, columns.data(), coefficients.data());
      double lower, upper;
      constraints_[i]->get_bounds(lower, upper);
      glp_set_row_bnds(&problem, row, CGAL::internal::bound_type(lower, upper), lower, upper);
    }
  }
};

} // namespace program

#endif // DETECT_PLANES_LIMITED_SOLVER_H
