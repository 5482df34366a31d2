// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace dhpmap::evaluator {

/// Style of ReportPage. A picture is enlarged while its hidden checkbox is checked, so no script is needed.
inline constexpr const char* kReportStyle = R"(
:root { --ink: #1c2430; --soft: #5b6675; --line: #e3e7ec; --accent: #2458d3; }
* { box-sizing: border-box; }
body { margin: 0; background: #f6f7f9; color: var(--ink); font: 15px/1.5 system-ui, "Segoe UI", Roboto, sans-serif; }
main { max-width: 1280px; margin: 0 auto; padding: 28px 24px 60px; }
h1 { font-size: 34px; line-height: 1.15; margin: 0 0 6px; letter-spacing: -0.02em; }
h2 { font-size: 21px; margin: 40px 0 12px; letter-spacing: -0.01em; }
h3 { font-size: 16px; margin: 0 0 10px; }
p { margin: 0 0 10px; max-width: 76ch; }
.soft, figcaption, small { color: var(--soft); }
.card { background: #fff; border: 1px solid var(--line); border-radius: 12px; padding: 18px; margin-bottom: 18px; }
.hero { display: grid; grid-template-columns: 1fr 1.15fr; gap: 28px; align-items: center; }
.tiles { display: grid; grid-template-columns: repeat(2, 1fr); gap: 12px; margin-top: 18px; }
.tile { border: 1px solid var(--line); border-radius: 10px; padding: 10px 14px; }
.tile b { display: block; font-size: 30px; line-height: 1.2; font-variant-numeric: tabular-nums; }
.views { display: grid; grid-template-columns: repeat(3, 1fr); gap: 14px; align-items: start; }
figure { margin: 0; }
figcaption { font-size: 13px; margin-top: 4px; }
img { width: 100%; height: auto; display: block; cursor: zoom-in; background: #fff; }
label { display: block; }
label input { position: absolute; opacity: 0; }
label input:focus-visible + img { outline: 3px solid var(--accent); }
label input:checked + img { position: fixed; inset: 0; z-index: 9; width: 100vw; height: 100vh; padding: 2vmin;
  object-fit: contain; cursor: zoom-out; }
.legend { display: flex; flex-wrap: wrap; gap: 6px 18px; margin: 0 0 12px; font-size: 14px; }
.legend i { display: inline-block; width: 12px; height: 12px; border-radius: 3px; margin-right: 6px; vertical-align: -1px; }
.dots i { border-radius: 50%; }
.scroll { overflow-x: auto; }
table { border-collapse: collapse; width: 100%; font-size: 14px; font-variant-numeric: tabular-nums; }
th, td { padding: 6px 10px; border-bottom: 1px solid var(--line); text-align: left; white-space: nowrap; }
th { color: var(--soft); font-weight: 600; font-size: 13px; vertical-align: bottom; }
td.n, th.n { text-align: right; }
tr:last-child td { border-bottom: 0; }
td.bar { min-width: 92px; background: linear-gradient(#dbe6fb, #dbe6fb) no-repeat left 6px center / var(--w) 24px; }
td.best { font-weight: 700; }
td small { display: block; white-space: normal; max-width: 34ch; }
.chart { width: 100%; height: auto; font: 12px system-ui, "Segoe UI", Roboto, sans-serif; }
.chart .grid { stroke: #e3e7ec; } .chart .row { stroke: #f1f3f6; } .chart .span { stroke: #c4ccd6; stroke-width: 2; }
.chart circle { stroke: #fff; stroke-width: 1.2; }
.chart text { fill: #5b6675; } .chart .tick { text-anchor: middle; font-size: 10px; }
.chart .measure { text-anchor: middle; font-weight: 700; fill: #1c2430; } .chart .name { text-anchor: end; fill: #1c2430; }
details { border-top: 1px solid var(--line); padding: 10px 0; }
summary { cursor: pointer; font-weight: 600; }
@media (max-width: 820px) { .hero, .views { grid-template-columns: 1fr; } }
@media print { body { background: #fff; } .card { break-inside: avoid; } }
)";

}  // namespace dhpmap::evaluator
