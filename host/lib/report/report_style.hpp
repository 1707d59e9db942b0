// The style sheet of report.html.
#pragma once

namespace host {

inline constexpr const char kReportStyle[] = R"css(
:root{color-scheme:light dark;--paper:#faf9f6;--card:#fff;--ink:#1c1e22;--soft:#5f656e;--line:#e0ddd5;
--accent:#a63d23;--good:#20764f;--bad:#b3261e;--code:#f1efe9}
@media (prefers-color-scheme:dark){:root{--paper:#121316;--card:#191b1f;--ink:#e9e7e2;--soft:#9ba0a9;
--line:#2b2e34;--accent:#f0916f;--good:#63c79a;--bad:#ff8a80;--code:#202329}}
*{box-sizing:border-box}
body{margin:0;background:var(--paper);color:var(--ink);font:15px/1.55 system-ui,-apple-system,"Segoe UI",sans-serif}
main,nav{max-width:1240px;margin:0 auto;padding:0 28px}
nav{display:flex;gap:22px;align-items:baseline;padding-top:22px;padding-bottom:14px;flex-wrap:wrap}
nav b{font-size:17px;letter-spacing:-.01em}nav a{color:var(--soft);text-decoration:none}nav a:hover{color:var(--accent)}
nav span{margin-left:auto;color:var(--soft);font-size:13px}
article{border-top:1px solid var(--line);padding:34px 0 50px}
h1{font-size:34px;line-height:1.15;letter-spacing:-.02em;margin:0 0 10px}
h2{font-size:19px;letter-spacing:-.01em;margin:44px 0 4px}
h3{font-size:15px;margin:0}
p{margin:0 0 12px;max-width:76ch}.soft,figcaption,.sub{color:var(--soft)}.sub{font-size:13.5px;margin-bottom:14px}
.lead{font-size:17px}
code,pre,.code{font:13px/1.6 ui-monospace,"Cascadia Mono",Menlo,Consolas,monospace}
pre{background:var(--code);border-radius:8px;padding:14px 18px;overflow-x:auto;margin:12px 0}
.tiles{display:grid;grid-template-columns:repeat(auto-fit,minmax(190px,1fr));gap:12px;margin:24px 0 8px}
.tile{background:var(--card);border:1px solid var(--line);border-radius:10px;padding:14px 16px}
.tile b{display:block;font-size:25px;line-height:1.2;letter-spacing:-.02em;font-variant-numeric:tabular-nums}
.tile span{font-size:13px;color:var(--soft)}.tile em{font-style:normal;font-size:13px;display:block}
.pictures{display:grid;grid-template-columns:repeat(auto-fill,minmax(215px,1fr));gap:16px}
.card{background:var(--card);border:1px solid var(--line);border-radius:10px;overflow:hidden;display:flex;flex-direction:column}
.card header{padding:12px 14px 10px}h3{overflow:hidden;text-overflow:ellipsis;white-space:nowrap}.card header p{font-size:12.5px;white-space:nowrap;overflow:hidden;text-overflow:ellipsis;color:var(--soft);margin:0}
.card figure{margin:0}.card img{display:block;width:100%;height:auto}
.card figcaption{font-size:12.5px;padding:8px 14px 10px}
.compare{position:relative;outline:none}
.compare::after{content:"";position:absolute;inset:0;background-size:100% 100%;display:none}
.compare:hover::after,.compare:focus::after{display:block}
.scale{display:flex;align-items:center;gap:8px;font-variant-numeric:tabular-nums;white-space:nowrap}
.scale i{flex:1;height:8px;border-radius:4px;background:linear-gradient(90deg,#000,#808080,#fff);border:1px solid var(--line)}
details{border-top:1px solid var(--line);font-size:13px;margin-top:auto}summary{cursor:pointer;padding:8px 14px;color:var(--soft)}
.channels{display:grid;grid-template-columns:repeat(3,1fr);gap:2px}.channels figcaption{padding:4px 8px}
.wide{overflow-x:auto;border:1px solid var(--line);border-radius:10px;background:var(--card)}
table{border-collapse:collapse;width:100%;font-variant-numeric:tabular-nums;font-size:14px}
th,td{padding:8px 10px;text-align:right;white-space:nowrap;border-bottom:1px solid var(--line)}
tr:last-child>*{border-bottom:0}thead th{font-weight:600;font-size:12.5px;color:var(--soft);vertical-align:bottom;line-height:1.3}
th:first-child,td:first-child{text-align:left;padding-left:14px}tbody th{font-weight:500}tbody th code{color:var(--soft);font-size:12px;display:block}
td.best{color:var(--good);font-weight:650}td.none{color:var(--soft)}td.text{text-align:left;white-space:normal}
tr.reference>*{background:color-mix(in srgb,var(--soft) 7%,transparent)}
.good{color:var(--good)}.bad{color:var(--bad);font-weight:650}
.plots{display:grid;grid-template-columns:repeat(auto-fit,minmax(440px,1fr));gap:16px}
.plots figure,.panel{margin:0;background:var(--card);border:1px solid var(--line);border-radius:10px;padding:14px}
.plot{display:block;width:100%;height:auto;max-width:760px;margin:0 auto}
.panel+.wide{margin-top:14px}
.dot{display:inline-block;width:10px;height:10px;border-radius:50%;margin-right:8px}
.share{display:flex;width:130px;height:10px;border-radius:5px;overflow:hidden;background:var(--line);margin-left:auto}
.key{display:inline-block;width:10px;height:10px;border-radius:2px;margin:0 5px 0 12px}
dl{display:grid;grid-template-columns:max-content 1fr;gap:4px 22px;margin:12px 0;font-size:14px}
dt{color:var(--soft)}dd{margin:0;overflow-wrap:anywhere}
footer{border-top:1px solid var(--line);color:var(--soft);font-size:13px;padding:18px 0 40px}
@media (max-width:560px){main,nav{padding-left:16px;padding-right:16px}.plots{grid-template-columns:1fr}h1{font-size:27px}}
@media print{.card,.tile,.plots figure,tr{break-inside:avoid}}
)css";

}  // namespace host
