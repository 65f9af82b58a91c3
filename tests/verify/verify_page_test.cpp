// SPDX-License-Identifier: Apache-2.0
#include <tetralight/verify/verify_page.h>

#include <gtest/gtest.h>

#include <tetralight/verify/html.h>
#include <tetralight/verify/verify_checks.h>
#include <algorithm>
#include <random>
#include <span>
#include <string>
#include <vector>

namespace tetralight {
namespace {

size_t count_of(const std::string& text, const std::string& part) {
    size_t count = 0;
    for (size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
        ++count;
    return count;
}

/// Probes with differences of `sigma` standard errors of 1 %, and as many places.
VerifyReport report_with(double sigma, size_t count = 40) {
    std::mt19937 random(7);
    std::normal_distribution<double> normal;
    VerifyReport report;
    report.referee = "path tracer";
    report.notes = {"It shares <the> loader."};
    report.volume_probe_count = 1000;
    for (size_t i = 0; i < count; ++i) {
        VerifyProbe probe;
        probe.probe = static_cast<uint32_t>(i);
        probe.position = glm::dvec3(static_cast<double>(i), 1.0, 2.0 * static_cast<double>(i % 7));
        probe.traced.mean = glm::dvec3(1.0 + static_cast<double>(i));
        probe.traced.error = probe.volume_error = 0.007 * probe.traced.mean;
        probe.volume = probe.traced.mean * (1.0 + 0.0099 * sigma * normal(random));
        probe.traced.sample_count = 256;
        report.probes.push_back(probe);
        VerifyPlace place;
        place.position = probe.position;
        place.answer = probe.volume;
        place.traced = probe.traced;
        report.places.push_back(place);
    }
    summarize(report);
    return report;
}

VerifyPageFacts facts_with(const std::string& name) {
    VerifyPageFacts facts;
    facts.scene_path = facts.volume_path = facts.command = facts.version = name;
    facts.settings = {{name, name}};
    facts.pictures = {{name, std::vector<std::byte>(5, std::byte{0xff})}};
    return facts;
}

/// Each element that is opened is closed, in the reverse order.
testing::AssertionResult is_well_formed(const std::string& page) {
    std::vector<std::string> open;
    for (size_t at = page.find('<'); at != std::string::npos; at = page.find('<', at + 1)) {
        const size_t end = page.find('>', at);
        if (end == std::string::npos) return testing::AssertionFailure() << "tag without end";
        const std::string tag = page.substr(at + 1, end - at - 1);
        const std::string name = tag.substr(0, tag.find_first_of(" \n"));
        if (name == "!DOCTYPE" || name == "meta" || name == "img" || tag.back() == '/') continue;
        if (name.front() != '/') {
            open.push_back(name);
        } else if (open.empty() || open.back() != name.substr(1)) {
            return testing::AssertionFailure() << name << " closes another element";
        } else {
            open.pop_back();
        }
    }
    if (!open.empty()) return testing::AssertionFailure() << open.back() << " is not closed";
    return testing::AssertionSuccess();
}

TEST(VerifyPage, IsWellFormedWithAndWithoutLight) {
    const VerifyPageFacts facts = facts_with("court.probes");
    VerifyReport dark;
    dark.probes.resize(3);
    dark.places.resize(2);
    summarize(dark);
    for (const VerifyReport& report : {report_with(1.0), report_with(8.0), dark, VerifyReport{}}) {
        EXPECT_TRUE(is_well_formed(verify_page(report, facts)));
    }
}

TEST(VerifyPage, EscapesNames) {
    const std::string name = "<script>alert('1')</script>\"&\x1b[31m\xff\xfe";
    const std::string page = verify_page(report_with(1.0), facts_with(name));
    EXPECT_TRUE(is_well_formed(page));
    EXPECT_EQ(page.find("<script"), std::string::npos);
    EXPECT_EQ(page.find('\x1b'), std::string::npos);
    EXPECT_EQ(page.find('\xff'), std::string::npos);
    EXPECT_NE(page.find("&lt;script&gt;alert(&#39;1&#39;)&lt;/script&gt;&quot;&amp;"),
              std::string::npos);
    EXPECT_NE(page.find("It shares &lt;the&gt; loader."), std::string::npos);
}

TEST(VerifyPage, NeedsNoOtherFile) {
    const std::string page = verify_page(report_with(1.0), facts_with("a"));
    EXPECT_EQ(count_of(page, "src="), count_of(page, "src=\"data:"));
    EXPECT_EQ(count_of(page, "href="), 0u);
    EXPECT_EQ(count_of(page, "http"), 0u);
    EXPECT_EQ(count_of(page, "<img "), count_of(page, "<img alt="));
    EXPECT_EQ(count_of(page, "<svg "), count_of(page, "role=\"img\"><title>"));
}

TEST(VerifyPage, ShowsTheNumbersOfTheReport) {
    const VerifyReport report = report_with(1.0);
    const std::string page = verify_page(report, facts_with("a"));
    for (const VerifyChannel& channel : report.channels) {
        EXPECT_NE(page.find(element("td", percent_text(channel.within_3_sigma))),
                  std::string::npos);
        EXPECT_NE(page.find(element("td", fixed_point(channel.mean_z, 3))), std::string::npos);
        EXPECT_NE(page.find(element("td", fixed_point(channel.rms_z, 3))), std::string::npos);
    }
    EXPECT_NE(page.find(percent_text(report.interpolation.mean)), std::string::npos);
    EXPECT_NE(page.find(element("td", percent_text(report.leak_share))), std::string::npos);
}

TEST(VerifyPage, SaysTheVerdictFirst) {
    const std::string good = verify_page(report_with(1.0, 400), facts_with("a"));
    const std::string bad = verify_page(report_with(8.0), facts_with("a"));
    EXPECT_LT(good.find("Passed: all"), good.find("What was compared"));
    EXPECT_LT(bad.find("Failed: "), bad.find("What was compared"));
}

/// The page and the exit code agree: one failure for each check that is not kept.
TEST(VerifyChecks, AgreeWithTheFailures) {
    for (const double sigma : {0.0, 1.0, 1.3, 3.0, 30.0, 100.0}) {
        for (const size_t count : {0, 1, 20, 500}) {
            const VerifyReport report = report_with(sigma, count);
            std::vector<std::string> expected, found;
            for (const auto& failure : check_limits(report, {}))
                expected.push_back(failure.setting);
            for (const VerifyCheck& check : list_checks(report, {})) {
                if (!check.is_kept) found.push_back(check.setting);
            }
            std::ranges::sort(expected);
            std::ranges::sort(found);
            EXPECT_EQ(found, expected) << sigma << " " << count;
        }
    }
}

TEST(Html, DataUrisAreBase64) {
    const auto uri_of = [](std::string_view text) {
        return data_uri("text/plain", std::as_bytes(std::span(text)));
    };
    // RFC 4648, section 10.
    EXPECT_EQ(uri_of("f"), "data:text/plain;base64,Zg==");
    EXPECT_EQ(uri_of("fo"), "data:text/plain;base64,Zm8=");
    EXPECT_EQ(uri_of("foobar"), "data:text/plain;base64,Zm9vYmFy");
}

}  // namespace
}  // namespace tetralight
