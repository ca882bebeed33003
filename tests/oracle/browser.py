"""browser.py FOLDER [TOOLS]: open FOLDER/index.html in headless Chromium, wide and narrow, light and dark, and try it.

The filters must show as many claims as audit.json has, sorting must put a failure first and back, a link to a claim must
open it, every formula must have a size, nothing may be wider than the page (360 pixels when narrow, where tables of class stack or few need no scrolling and name the column
of each cell), no script may fail and
nothing may be loaded; the letter takes two screens of 1280 x 800 at most, the archive is folded, and what is printed of the page
takes 12 sheets at most; every link into the page must lead to something that is shown.  TOOLS: the folder for axe-core
(axe.py), by which the page must then be accessible, narrow in light and wide in dark, with every 24th claim and the
first of each verdict or, with STICKSLIP_TESTS=all in the environment, at both widths in light and in dark with all of
them; where it cannot be had, a line says why.  One line for each error; exit status 0, 1 with errors, 2 where the
browser gave no answer.
"""
import concurrent.futures
import html
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile

import axe

SCRIPT = """
var failed = null;
window.addEventListener('error', function (e) { failed = String(e.message); });
document.addEventListener('securitypolicyviolation', function (e) { failed = 'blocked: ' + e.blockedURI; });
['error', 'warn'].forEach(function (level) {
  console[level] = function () { failed = 'console: ' + Array.from(arguments).join(' '); };
});
window.addEventListener('unhandledrejection', function (e) { failed = String(e.reason); });
window.addEventListener('load', async function () {
  var out = {}, rows = Array.from(document.querySelectorAll('#claims > tbody')), narrow = NARROW;
  function shown() { return rows.filter(function (r) { return !r.hidden; }).length; }
  function set(id, value) {
    var e = document.getElementById(id);
    e.value = value;
    e.dispatchEvent(new Event('input', {bubbles: true}));
  }
  function choices(id) { return Array.from(document.getElementById(id).options).filter(function (o) { return o.value; }); }
  function first() { return document.querySelector('#claims > tbody').id; }
  function count(id) {
    var n = {};
    choices(id).forEach(function (o) { set(id, o.value); n[o.textContent.replace(/ \\(.*/, '')] = shown(); });
    set(id, '');
    return n;
  }
  out.all = shown();
  out.verdicts = count('by-v');
  out.sections = count('by-s');
  out.routes = count('by-r');
  set('by-t', 'zzz no such words'); out.none = shown(); set('by-t', '');
  out.before = first(); set('order', 'w'); out.worst = first(); set('order', 'i'); out.after = first();
  set('by-t', 'zzz no such words');
  function folds(e) { return e.parentElement.closest('details'); }
  out.folded = Array.from(document.querySelectorAll('#s-archive > details')).every(function (d) { return !d.open; });
  out.letter = document.getElementById('s-letter').getBoundingClientRect().bottom + window.scrollY;
  out.badges = document.querySelectorAll('#s-letter .v, #s-findings li .v').length;
  location.hash = rows[0].id;
  await new Promise(function (r) { setTimeout(r, 200); });
  out.opened = rows[0].querySelector('details').open && folds(rows[0]).open && !rows[0].hidden;
  location.hash = 's-words';
  await new Promise(function (r) { setTimeout(r, 200); });
  out.opened = out.opened && folds(document.getElementById('s-words')).open;
  document.querySelectorAll('details').forEach(function (d) { d.open = true; });
  if (narrow) document.documentElement.style.width = '360px';
  window.dispatchEvent(new Event('resize'));
  var width = document.documentElement.getBoundingClientRect().width + 1;
  out.wide = Array.from(document.querySelectorAll('main *')).filter(function (e) {
    if (e.parentElement.closest('.wide, .tex, svg, math')) return false;
    return e.getBoundingClientRect().right > width;
  }).map(function (e) { return e.outerHTML.slice(0, 80); }).slice(0, 5);
  out.scrolls = !narrow ? [] : Array.from(document.querySelectorAll('.wide > .stack, .wide > .narrow, .wide > .few')).filter(function (t) {
    return t.parentElement.scrollWidth > t.parentElement.clientWidth + 1;
  }).map(function (t) { return t.textContent.slice(0, 80); }).slice(0, 5);
  out.unnamed = Array.from(document.querySelectorAll('.stack td')).filter(function (td) {
    return td.dataset.of !== td.closest('table').querySelectorAll('thead th')[td.cellIndex].textContent;
  }).length;
  var maths = Array.from(document.querySelectorAll('math'));
  out.formulas = maths.length;
  out.flat = maths.filter(function (m) { var b = m.getBoundingClientRect(); return !(b.width > 1 && b.height > 1); }).length;
  out.foreign = maths.filter(function (m) { return m.namespaceURI !== 'http://www.w3.org/1998/Math/MathML'; }).length;
  out.astray = Array.from(document.querySelectorAll('a[href^="#"]')).map(function (a) {
    return a.getAttribute('href');
  }).filter(function (href) {
    var to = document.getElementById(decodeURIComponent(href.slice(1)));
    return !to || !to.getClientRects().length;
  });
  out.background = getComputedStyle(document.body).backgroundColor;
  async function violations(options) {
    options.resultTypes = ['violations'];
    var found = await axe.run(document, options);
    return found.violations.map(function (v) { return v.id + ': ' + v.nodes[0].html.slice(0, 100); });
  }
  var kept = {};
  rows.forEach(function (r, i) { if (i % EVERY && kept[r.dataset.v]) r.remove(); else kept[r.dataset.v] = true; });
  out.axe = window.axe ? await violations({}) : [];
  document.getElementById('theme').click();
  out.turned = getComputedStyle(document.body).backgroundColor;
  if (window.axe && EVERY === 1) out.axe = out.axe.concat(await violations({runOnly: ['color-contrast']}));
  out.loaded = performance.getEntriesByType('resource').map(function (e) { return e.name; });
  out.failed = failed;
  document.body.textContent = 'RESULT' + JSON.stringify(out) + 'END';
});
"""


def ask(page, checker, narrow, dark):
    """What the page says about itself."""
    inline = "<script>" + checker.replace("</script", "<\\/script") + "</script>" if checker else ""
    every = "1" if os.environ.get("STICKSLIP_TESTS") == "all" else "24"
    script = "<script>" + SCRIPT.replace("NARROW", "true" if narrow else "false").replace("EVERY", every) + "</script>"
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder, "page.html")
        path.write_text(page.replace("<head>", "<head>" + script + inline, 1), encoding="utf-8")
        command = ["chromium", "--headless", "--no-sandbox", "--disable-gpu", "--user-data-dir=" + folder,
                   "--window-size=%d,900" % (500 if narrow else 1280), "--virtual-time-budget=60000",
                   "--blink-settings=preferredColorScheme=%d" % (0 if dark else 1), "--dump-dom", path.as_uri()]
        done = subprocess.run(command, capture_output=True, timeout=250, check=False)
    m = re.search("<body[^>]*>RESULT(.*)END</body>", done.stdout.decode("utf-8", "replace"), re.S)
    return json.loads(html.unescape(m[1])) if m else None


def sheets(page):
    """How many pages are printed."""
    with tempfile.TemporaryDirectory() as folder:
        path, pdf = pathlib.Path(folder, "page.html"), pathlib.Path(folder, "page.pdf")
        path.write_text(page, encoding="utf-8")
        subprocess.run(["chromium", "--headless", "--no-sandbox", "--disable-gpu", "--user-data-dir=" + folder,
                        "--print-to-pdf=%s" % pdf, path.as_uri()], capture_output=True, timeout=250, check=False)
        return len(re.findall(rb"/Type\s*/Page\b", pdf.read_bytes())) if pdf.exists() else None


def errors(out, audit, dark):
    claims = audit["claims"]
    verdicts, sections, routes = {}, {}, {}
    for c in claims:
        verdicts[c["verdict"]] = verdicts.get(c["verdict"], 0) + 1
        name = (c["section"] or "-").replace("_", " ")
        sections[name] = sections.get(name, 0) + 1
        for route in {e["route"] for e in c["evidence"]}:
            routes[route] = routes.get(route, 0) + 1
    for name, want in (("all", len(claims)), ("verdicts", verdicts), ("sections", sections), ("routes", routes),
                       ("none", 0), ("opened", True), ("folded", True), ("badges", 0), ("wide", []), ("scrolls", []), ("unnamed", 0), ("flat", 0), ("foreign", 0), ("loaded", []),
                       ("failed", None), ("astray", [])):
        if out[name] != want:
            yield "%s: %s, not %s" % (name, out[name], want)
    if dark and out["letter"] > 2 * 800:  # asked at 1280 pixels
        yield "the letter ends at %.0f pixels" % out["letter"]
    failing = {"c-" + c["id"] for c in claims if c["verdict"] in ("refuted", "conditional")}
    if failing and (out["worst"] not in failing or out["before"] != out["after"]):
        yield "sorting: %s, %s, %s" % (out["before"], out["worst"], out["after"])
    if not out["formulas"]:
        yield "no formulas"
    for name, wanted in (("background", not dark), ("turned", dark)):
        light = sum(int(x) for x in re.findall(r"\d+", out[name])[:3]) > 384
        if light != wanted:
            yield "%s %s where it is %s" % (name, out[name], "light" if wanted else "dark")
    yield from out["axe"]


def main():
    folder = pathlib.Path(sys.argv[1])
    checker = None
    try:
        checker = axe.fetch(sys.argv[2]) if len(sys.argv) > 2 else None
    except OSError as e:
        print("accessibility not checked: %s" % e)
    page = (folder / "index.html").read_text(encoding="utf-8")
    audit = json.loads((folder / "audit.json").read_text(encoding="utf-8"))
    status = 0
    ways = ((True, False), (False, True))
    with concurrent.futures.ThreadPoolExecutor() as pool:
        answers = list(pool.map(lambda way: ask(page, checker, *way), ways))
    for (narrow, dark), out in zip(ways, answers):
        if out is None:
            print("no answer of the browser")
            return 2
        for e in errors(out, audit, dark):
            print("%s, %s: %s" % ("narrow" if narrow else "wide", "dark" if dark else "light", e))
            status = 1
    printed = sheets(page)
    if printed is None or not 0 < printed <= 12:
        print("printed on %s sheets" % printed)
        status = 1
    return status


if __name__ == "__main__":
    sys.exit(main())
