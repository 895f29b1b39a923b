// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_SHAPE_REGULARIZATION_TANDEM_PLANAR_SHAPE_DETECTION_3_H
#define CGAL_SHAPE_REGULARIZATION_TANDEM_PLANAR_SHAPE_DETECTION_3_H

#include <CGAL/Shape_regularization_tandem/Planar_shapes_3.h>
#include <CGAL/Shape_regularization_tandem/internal/method.h>
#include <CGAL/Shape_regularization_tandem/internal/range_maps.h>
#include <CGAL/Shape_regularization_tandem/internal/resolve_parameters.h>
#include <CGAL/Tandem/internal/backend/Ranks.h>
#include <CGAL/Tandem/internal/base/Progress.h>
#include <CGAL/Tandem/internal/base/listed_parameters.h>
#include <CGAL/Tandem/internal/cloud/import_cloud.h>
#ifndef CGAL_TANDEM_USE_ENGINE // which has compiled it
#include <CGAL/Tandem/internal/engine/Engine.h>
#endif

#include <chrono>
#include <memory>
#include <stdexcept>
#include <string>

namespace CGAL::Tandem {
namespace internal {

inline double seconds_since(std::chrono::steady_clock::time_point start)
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

} // namespace internal

/*!
\ingroup PkgShapeRegularizationTandemRef

\brief detects and regularizes planar shapes in tandem, step by step.

The constructor reads the range once, through its maps; the range is not needed afterwards. After an exception, such as
one that the callback throws, there are no shapes: `iterate()`, `detect()`, `finish()` and `shapes()` throw
`std::logic_error`.

\tparam Traits a model of `TandemTraits_3`
*/
template <class Traits>
class Planar_shape_detection_3 {
public:
  /// the kernel
  using Geom_traits = typename Traits::Geom_traits;
  /// the range of the points
  using Point_range = typename Traits::Point_range;
  /// the result
  using Shapes = Planar_shapes_3<Geom_traits>;

  /*!
  copies the points, estimates the parameters that are not given, and finds the neighbors of the points. There are no
  shapes yet.
  \param points a range of points
  \param np the named parameters of `detect_planes()`
  \throw std::exception as `detect_planes()`
  */
  template <class NamedParameters = CGAL::parameters::Default_named_parameters>
  explicit Planar_shape_detection_3(const Point_range& points, const NamedParameters& np = NamedParameters())
    : Planar_shape_detection_3(points, np, internal::make_traits<Traits>(np))
  {
    internal::Is_readable<Traits, NamedParameters>(); // here, so that an error names the line of the caller
  }

  /*!
  does the same with the given traits, which are copied. Its named parameters `geom_traits` and `communicator` are not
  read: the traits have the kernel and, with `Mpi_tag`, the communicator.
  \param points a range of points
  \param np the named parameters of `detect_planes()`
  \param traits the traits
  \throw std::exception as the constructor above
  */
  template <class NamedParameters>
  Planar_shape_detection_3(const Point_range& points, const NamedParameters& np, const Traits& traits)
    : traits_(traits), backend_(traits_.backend()),
      parameters_(Ranks(backend_).together([&] { return internal::read_parameters(np); })),
      progress_(joined(internal::parameter<internal_np::callback_t>(np, Callback())))
  {
    const internal::Round_to_nearest rounding;
    together([&] {
      internal::check_given_parameters(parameters_);
      internal::check_same_parameters(Ranks(backend_), parameters_);
      const auto start = std::chrono::steady_clock::now();
      in_ = internal::read_range<typename Execution::Upload>(backend_, points, np, traits_);
      estimate_note_ = internal::set_scale(backend_, in_, internal::has_own_offset(np), parameters_);
      import_time_ = internal::seconds_since(start);
      if(progress_.show(0) && in_.total.points >= parameters_.minimum_region_size)
        engine_ = Execution::start(backend_, in_, parameters_, progress_);
      in_.uploaded.reset(); // without an engine nobody needs the values
    });
  }

  // The engine refers to members.
  Planar_shape_detection_3(const Planar_shape_detection_3&) = delete;
  Planar_shape_detection_3& operator=(const Planar_shape_detection_3&) = delete;

  /// calls `iterate()` until no shape grows or the callback that the constructor got cancels the detection, and in both
  /// cases `finish()`. Returns `true` if the detection is complete, `false` if it was cancelled: then `shapes()` has
  /// the shapes found until then. Throws what the callback throws, and `std::runtime_error` if a device fails.
  bool detect()
  {
    while(iterate()) {
    }
    finish();
    return !is_cancelled();
  }

  /// does one round of growth and regularization, as in Algorithm 1 of \cgalCite{OLA16}. Call it until it returns
  /// `false`, which says that hardly anything grows or that the callback has cancelled the detection; then call
  /// `finish()`. Between rounds `shapes()` shows what there is.
  bool iterate()
  {
    const internal::Round_to_nearest rounding;
    check_complete();
    return engine_ && !is_finished_ && !is_cancelled() && together([&] { return engine_->iterate(); });
  }

  /// finds the final shapes, and checks each point against the final plane of its shape. After a cancellation these are
  /// the shapes found until then. Afterwards `shapes()` has all that the package guarantees. Does nothing when called
  /// again.
  void finish()
  {
    const internal::Round_to_nearest rounding;
    if(is_finished_)
      return;
    check_complete();
    if(engine_)
      together([&] { engine_->finish(); });
    is_finished_ = true;
    together([&] { progress_.show_end(); });
  }

  /// returns the shapes. Before `finish()` these are the shapes after the last call of `iterate()`, without relations if
  /// hardly anything grew, for which the guarantees need not hold yet; after `finish()` they are the final ones. The
  /// result does not change or end with the detection. Copies of it share the memory of their tables.
  Shapes shapes() const
  {
    const internal::Round_to_nearest rounding;
    check_complete();
    Backend backend = traits_.backend();
    return Ranks(backend).together([&] {
      const auto start = std::chrono::steady_clock::now();
      internal::Shapes_data data =
        internal::export_shapes(backend, in_, parameters_, engine_ ? engine_->result() : internal::Engine_result());
      Statistics& statistics = data.statistics;
      statistics.is_cancelled = is_cancelled();
      statistics.estimate_note = estimate_note_;
      statistics.angle_note = internal::angle_note(parameters_);
      statistics.backend = engine_ ? engine_->name() : Backend::name();
      Stage_times& times = statistics.times;
      times.sort += import_time_;
      times.finish += internal::seconds_since(start);
      times.total = times.normals + times.sort + times.neighbors + times.growth + times.regularity + times.finish;
      return Shapes(std::move(data), traits_.geom_traits());
    });
  }

  /// returns the parameters in use, estimated ones included
  const Parameters& parameters() const { return parameters_; }

  /// returns whether the callback has cancelled the detection. If it did so after the last round, the result is
  /// complete.
  bool is_cancelled() const { return progress_.is_cancelled(); }

private:
  using Backend = typename Traits::Backend;
  using Execution = typename Traits::Execution;
  using Ranks = internal::Ranks<Backend>;

  // The callback that calls those of all ranks. Ranks without one agree with the others.
  Callback joined(const Callback& callback)
  {
    if constexpr(!Ranks::are_many)
      return callback;
    else
      return [this, callback](double progress) {
        return Ranks(backend_).total(std::size_t(callback && !callback(progress))) == 0;
      };
  }

  // f() on all ranks. What it throws ends the detection.
  template <class F>
  auto together(F f)
  {
    try {
      return Ranks(backend_).together(f);
    } catch(...) {
      has_thrown_ = true;
      throw;
    }
  }

  void check_complete() const
  {
    if(has_thrown_ && !is_finished_)
      throw std::logic_error("the detection has ended by an exception: there are no shapes");
  }

  Traits traits_;
  Backend backend_;
  Parameters parameters_;
  internal::Progress progress_;
  internal::Import in_;
  std::string estimate_note_;
  double import_time_ = 0;
  bool is_finished_ = false;
  bool has_thrown_ = false;
  std::unique_ptr<internal::Detection_engine> engine_;
};

} // namespace CGAL::Tandem

#endif // CGAL_SHAPE_REGULARIZATION_TANDEM_PLANAR_SHAPE_DETECTION_3_H
