// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cstdlib>
#include <sstream>
#include <string>
#include <utility>

namespace tetralight::test {

/// Whether the environment asks for the sizes of a night: TETRALIGHT_NIGHTLY=1.
inline bool is_nightly() {
    const char* value = std::getenv("TETRALIGHT_NIGHTLY");
    return value != nullptr && std::string(value) == "1";
}

/// Checks a property on so many random cases, small ones first. They are the same in every run,
/// unless the environment's RC_PARAMS says otherwise; a case that fails is shrunk and shown.
template <class Property>
void check_property(int case_count, Property&& property) {
    rc::detail::TestParams params = rc::detail::configuration().testParams;
    if (std::getenv("RC_PARAMS") == nullptr) {
        params.seed = 1;
        params.maxSuccess = case_count;
    }
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    rc::detail::TestMetadata metadata;
    metadata.id = std::string(info->test_suite_name()) + "/" + info->name();
    const auto result =
        rc::detail::checkTestable(std::forward<Property>(property), metadata, params);
    if (result.template is<rc::detail::SuccessResult>()) return;
    std::ostringstream message;
    rc::detail::printResultMessage(result, message);
    ADD_FAILURE() << message.str();
}

}  // namespace tetralight::test
