// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The choice between device and host, with a device of this test: its engine is used where it can be made; otherwise
// the host has the values and gives the same result. What the callback throws is no failure of the device.

#include "api_support.h"

#include <functional>

namespace CGAL {
namespace Tandem {

struct Test_device_tag {};

namespace internal {

template <>
struct Execution_of<Test_device_tag> : Cuda_or_host_execution<Sequential_backend> {
  using Upload = No_upload;
};

// Returns the engine of the device; called by make_cuda_engine(), which is that of the library elsewhere.
std::function<std::unique_ptr<Detection_engine>(Import&, const Parameters&, Progress&)> test_device;

std::unique_ptr<Detection_engine> make_cuda_engine(Import& in, const Parameters& parameters, Progress& progress)
{
  return test_device(in, parameters, progress);
}

// An engine from outside of the package: the sequential one under another name.
class Device_engine : public Detection_engine {
public:
  Device_engine(Import& in, const Parameters& parameters, Progress& progress)
    : engine_(make_engine(backend_, in, parameters, progress))
  {}

  const char* name() const override { return "device"; }
  bool iterate() override { return engine_->iterate(); }
  void finish() override { engine_->finish(); }
  Engine_result result() override { return engine_->result(); }

private:
  Sequential_backend backend_;
  std::unique_ptr<Detection_engine> engine_;
};

// Takes the coordinates away until the host asks for them.
class Kept_coordinates : public Uploaded_values {
public:
  explicit Kept_coordinates(Import& in) : table_(in.coordinates.data<double>()), kept_(table_, table_ + 3 * in.size())
  {
    std::fill(table_, table_ + kept_.size(), 0.);
  }
  void download() override { std::copy(kept_.begin(), kept_.end(), table_); }

private:
  double* table_;
  std::vector<double> kept_;
};

} // namespace internal
} // namespace Tandem
} // namespace CGAL

BOOST_AUTO_TEST_SUITE(test_engine_choice)

using namespace CGAL::Tandem::internal;

const Cloud cloud = to_cloud(scenes::make_scene("cube", scene_options(3000)));
const Parameters parameters = make_parameters(.02, 40);
int calls = 0; // of the callback; the first one comes before the engine

std::unique_ptr<Detection_engine> make_device(Import& in, const Parameters& p, Progress& progress)
{
  return std::make_unique<Device_engine>(in, p, progress);
}

Shapes detect_with(const CGAL::Tandem::Callback& callback)
{
  calls = 0;
  return CGAL::Tandem::detect_planes<CGAL::Tandem::Test_device_tag>(
    cloud, maps.settings(parameters).callback([&](double fraction) { return ++calls == 1 || callback(fraction); }));
}

Shapes detect_calmly()
{
  return detect_with([](double) { return true; });
}

BOOST_AUTO_TEST_CASE(test_device_is_used)
{
  test_device = make_device;
  const Shapes shapes = detect_calmly();
  check_equal(shapes.statistics().backend, "device", "back end");
  check_same(shapes, detect(cloud, parameters), "device");
  CHECK(shapes.number_of_shapes() == 6);
}

template <class Failure>
void check_failure(const std::string& name)
{
  test_device = [&](Import& in, const Parameters&, Progress&) -> std::unique_ptr<Detection_engine> {
    in.uploaded = std::make_shared<Kept_coordinates>(in);
    throw Failure(name);
  };
  const Shapes shapes = detect_calmly();
  check_equal(shapes.statistics().backend, Sequential_backend::name(), name);
  check_same(shapes, detect(cloud, parameters), name);
}

// Of the callback, of one of the types that mean a failure of the device elsewhere.
template <class Exception>
void check_passes()
{
  test_device = make_device;
  check_throws<Exception>([&] { detect_with([](double) -> bool { throw Exception("passes"); }); }, {"passes"},
                          __LINE__);
  check_equal(calls, 2, "calls");
}

BOOST_AUTO_TEST_CASE(test_failures)
{
  check_failure<std::runtime_error>("no device");
  check_failure<std::length_error>("too little memory");
  check_passes<std::runtime_error>();
  check_passes<std::length_error>();
  // Other types mean none.
  test_device = [](Import&, const Parameters&, Progress&) -> std::unique_ptr<Detection_engine> {
    throw std::logic_error("passes");
  };
  check_throws<std::logic_error>(detect_calmly, {"passes"}, __LINE__);
  check_equal(calls, 1, "calls");
}

BOOST_AUTO_TEST_SUITE_END()
