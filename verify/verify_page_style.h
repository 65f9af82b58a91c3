// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace tetralight {

/// The style sheet of a page of `verify_page`, for light and dark screens and for print.
inline constexpr const char* kVerifyPageStyle = R"(
:root { color-scheme: light dark; --page: #ffffff; --text: #1c2127; --faint: #59636e; --rule: #d0d7de;
  --panel: #f6f8fa; --good: #116329; --bad: #b3261e; --red: #c62828; --green: #2e7d32; --blue: #1565c0;
  --d0: #1a4e9c; --d1: #3f7fcf; --d2: #8bb4e6; --d3: #9aa3ab; --d4: #f0ac6a; --d5: #dc7520; --d6: #a8430a; }
@media (prefers-color-scheme: dark) {
  :root { --page: #14181d; --text: #e4e8ec; --faint: #9aa5b1; --rule: #39424c; --panel: #1d232a;
    --good: #6fdd8b; --bad: #ff8a80; --red: #ff7b72; --green: #56d364; --blue: #79b8ff;
    --d0: #79b0ff; --d1: #4f8de0; --d2: #33609f; --d3: #6b7580; --d4: #a1622a; --d5: #e08a3c; --d6: #ffb66e; } }
* { box-sizing: border-box; }
body { margin: 0 auto; padding: 1.5rem; max-width: 68rem; background: var(--page); color: var(--text);
  font: 1rem/1.5 system-ui, sans-serif; }
h1 { font-size: 1.5rem; line-height: 1.25; margin: 0 0 .5rem; }
h2 { font-size: 1.15rem; margin: 2.2rem 0 .5rem; padding-top: .8rem; border-top: 1px solid var(--rule); }
p, ul { max-width: 46rem; margin: .4rem 0; }
.good { color: var(--good); } .bad { color: var(--bad); }
.verdict { font-size: 1.1rem; padding: .7rem 1rem; border-left: .35rem solid currentColor; background: var(--panel);
  max-width: none; }
.files { overflow-wrap: anywhere; }
.wide { overflow-x: auto; }
table { border-collapse: collapse; font-size: .875rem; margin: .7rem 0; font-variant-numeric: tabular-nums; }
caption { text-align: left; color: var(--faint); padding-bottom: .3rem; }
th, td { padding: .25rem .7rem .25rem 0; text-align: left; border-bottom: 1px solid var(--rule);
  vertical-align: top; font-weight: normal; }
thead th { font-weight: 600; white-space: nowrap; }
td { white-space: nowrap; }
.three, .two { display: grid; gap: 1rem; grid-template-columns: repeat(auto-fit, minmax(18rem, 1fr)); }
figure { margin: .5rem 0; } figcaption { font-size: .875rem; color: var(--faint); }
img { max-width: 100%; height: auto; display: block; } svg { width: 100%; height: auto; display: block; }
svg text { font: 11px system-ui, sans-serif; fill: var(--faint); }
svg .middle { text-anchor: middle; } svg .end { text-anchor: end; }
svg .frame { fill: none; stroke: var(--rule); } svg .grid { stroke: var(--rule); stroke-width: .5; }
svg .axis { stroke: var(--text); stroke-width: 2; } svg .bar { stroke: var(--faint); stroke-width: .8; }
svg .limit { stroke: var(--bad); stroke-dasharray: 3 3; }
svg .curve { fill: none; stroke: var(--text); stroke-width: 1.2; }
svg .red { fill: var(--red); } svg .green { fill: var(--green); } svg .blue { fill: var(--blue); }
svg .far { fill: none; stroke: var(--bad); stroke-width: 1.6; }
svg .d0 { fill: var(--d0); } svg .d1 { fill: var(--d1); } svg .d2 { fill: var(--d2); } svg .d3 { fill: var(--d3); }
svg .d4 { fill: var(--d4); } svg .d5 { fill: var(--d5); } svg .d6 { fill: var(--d6); }
svg .special { stroke: var(--bad); stroke-width: 2; }
.key span { display: inline-block; width: .8rem; height: .8rem; border-radius: 50%; margin: 0 .3rem 0 .9rem;
  vertical-align: -.05rem; }
pre { background: var(--panel); padding: .7rem 1rem; overflow-x: auto; font-size: .875rem; }
@media print { body { max-width: none; } h2 { break-after: avoid; } figure, tr { break-inside: avoid; } }
)";

}  // namespace tetralight
