// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#define BOOST_TEST_MODULE Tandem
#include <boost/test/unit_test.hpp>
