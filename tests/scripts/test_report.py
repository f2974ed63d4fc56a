"""scripts/report.py on a study that isochor runs, looked at in a browser as on a phone; and what becomes
of a README, of a study's parts, and of wrong input."""

import csv
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from html.parser import HTMLParser
from pathlib import Path

SCRIPTS = Path(__file__).parents[2] / "scripts"
sys.path.insert(0, str(SCRIPTS))
sys.dont_write_bytecode = True

from report_readme import readme_html  # noqa: E402

ISOCHOR = os.environ["ISOCHOR"]
PHONE = 390  # pixels
STUDY = """subsection Scene
  set Mesh            = box(0.4, 0.1, 0.1)
  set Cells           = {{4, 1, 1|6, 1, 1}}
  set Poisson ratio   = {{0.3|0.5}}
  set Density         = 1000
  set Young's modulus = 1e5
  set Fixed           = left
  set Gravity         = 0, -9.8, 0
  set Probes          = tip: mean displacement y on right
end
subsection Method
  set Element = {{P1|P1-P1s|P2-P1}}
end
subsection Output
  set VTU = final
end
subsection Study
  set Title     = A short beam
  set Reference = Method/Element = P2-P1; Scene/Cells = 6, 1, 1
end
"""
README = """# A beam & its *errors*

**What.** A beam, `E` < 1, see [the file](study.prm), [a site](https://example.org/a?b=1&c=2).

<!-- begin: values baseline.csv -->
| element | 0.3 |
| --- | --- |
| P1 | **38 %** |
<!-- end -->

### Deep

- one
- two <script>alert(1)</script>

![Error of the tip](tip_error_against_poisson_ratio.png)
![A picture](picture.png)
![Not there](gone.png)

    scripts/rerun_study.py beam
"""
# Tells what a reader's browser makes of the page, to a page around it that has it in a frame: a window
# of the browser itself is not as narrow as a phone.
MEASURE = """<script>
window.addEventListener("load", function () {
  var sizes = Array.from(document.querySelectorAll("img, svg")).map(function (element) {
    var box = element.getBoundingClientRect();
    return [box.width, box.height, element.tagName !== "IMG" || element.naturalWidth > 0];
  });
  var data = {width: document.documentElement.scrollWidth, window: window.innerWidth, sizes: sizes};
  parent.postMessage(JSON.stringify(data), "*");
});
</script></body>"""
FRAME = """<!DOCTYPE html><meta charset="utf-8"><link rel="icon" href="data:,"><script>
window.addEventListener("message", function (event) {
  var note = document.createElement("pre");
  note.id = "measured";
  note.textContent = event.data;
  document.body.appendChild(note);
});
</script><body style="margin: 0">
<iframe src="shown.html" style="width: WIDTHpx; height: 4000px; border: 0"></iframe></body>"""


class Page(HTMLParser):
    """ids, links and headings of a page, and its elements with attributes."""

    def __init__(self, text):
        super().__init__()
        self.elements = []
        self.feed(text)
        self.ids = [attributes["id"] for _, attributes in self.elements if "id" in attributes]
        self.headings = [int(tag[1]) for tag, _ in self.elements if re.fullmatch(r"h[1-6]", tag)]
        self.targets = [value for _, attributes in self.elements for name, value in
                        attributes.items() if name in ("href", "src", "xlink:href", "srcset")]

    def handle_starttag(self, tag, attributes):
        self.elements.append((tag, dict(attributes)))


class Reports(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.file = self.folder / "report.html"
        (self.folder / "beam.prm").write_text(STUDY)

    def run_study(self):
        result = subprocess.run([ISOCHOR, self.folder / "beam.prm", "--output", self.folder / "beam"],
                                capture_output=True, text=True,
                                env=dict(os.environ, OMP_NUM_THREADS="1"))
        self.assertEqual(result.returncode, 2, result.stderr)  # P1 is refused at 0.5
        return self.folder / "beam"

    def run_script(self, *arguments):
        return subprocess.run([SCRIPTS / "report.py", *arguments, "-o", self.file,
                               "--isochor", ISOCHOR], capture_output=True, text=True)

    def make(self, *arguments):
        result = self.run_script(*arguments)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        return self.file.read_text()

    def sound(self, text):
        """Nothing leads out of the page, all that is referred to is there, headings in order."""
        page = Page(text)
        self.assertEqual(len(page.ids), len(set(page.ids)))
        for target in page.targets:
            self.assertRegex(target, "^(#|data:)")
            if target.startswith("#"):
                self.assertIn(target[1:], page.ids)
        for reference in re.findall(r"url\(([^)]*)\)", text):
            self.assertIn(reference.strip("'\"")[1:], page.ids)
        self.assertEqual(page.headings[0], 1)
        for before, after in zip(page.headings, page.headings[1:]):
            self.assertLessEqual(after, before + 1)
            self.assertGreater(after, 1)
        for tag, attributes in page.elements:
            if tag == "img":
                self.assertTrue(attributes["alt"])
            if tag == "svg":
                self.assertTrue(attributes["aria-label"])
        return page

    def in_browser(self, text, width):
        """What a browser without a network measures."""
        (self.folder / "shown.html").write_text(text.replace("</body>", MEASURE))
        frame = self.folder / "frame.html"
        frame.write_text(FRAME.replace("WIDTH", str(width)))
        result = subprocess.run(
            ["chromium", "--headless", "--no-sandbox", "--disable-gpu", "--enable-logging=stderr",
             f"--user-data-dir={self.folder / 'browser'}", "--window-size=1200,4000",
             "--host-resolver-rules=MAP * ~NOTFOUND", "--virtual-time-budget=10000", "--dump-dom",
             frame.as_uri()], capture_output=True, text=True, timeout=300)
        found = re.search(r'<pre id="measured">(.*?)</pre>', result.stdout)
        self.assertTrue(found, result.stderr)
        self.assertNotIn("CONSOLE", result.stderr)
        return json.loads(found[1])

    def readable(self, text, n_least, widths=(PHONE, 1200)):
        for width in widths:
            found = self.in_browser(text, width)
            self.assertEqual(found["window"], width)
            self.assertLessEqual(found["width"], width)
            self.assertGreaterEqual(len(found["sizes"]), n_least)
            for image_width, height, is_loaded in found["sizes"]:
                self.assertGreater(image_width, 0)
                self.assertGreater(height, 0)
                self.assertTrue(is_loaded)

    def test_folder_of_isochor(self):
        text = self.make(self.run_study())
        page = self.sound(text)
        for part in ("pictures", "charts", "runs", "parameters", "versions"):
            self.assertIn(part, page.ids)
        self.assertIn("<h1>A short beam</h1>", text)
        self.assertIn("set Young's modulus", text.replace("&#x27;", "'"))
        self.assertIn("Isochor", text)
        # All runs, and why two of them are none.
        with open(self.folder / "beam" / "results.csv", newline="") as stream:
            self.assertEqual(text.count("<tr><td>") + text.count('<tr class="failed">'),
                             len(list(csv.DictReader(stream))))
        self.assertEqual(text.count('<tr class="failed">'), 2)
        self.assertIn("P1 has no pressure", text)
        # The chart scripts' four kinds, and one picture.
        svgs = [attributes for tag, attributes in page.elements if tag == "svg"]
        self.assertEqual(len(svgs), 5)
        self.assertEqual(text.count("<img"), 1)
        self.readable(text, 6)

    def test_study_of_parts(self):
        """README and charts from baselines, a picture from a run made again."""
        results = self.run_study() / "results.csv"
        study = self.folder / "studies"
        study.mkdir()
        (study / "README.md").write_text(README)
        lines = results.read_text().splitlines(keepends=True)
        few = lines[:1] + [line for line in lines if line.startswith('"4, 1, 1",0.5,')]
        for prm, table, text in (("study", "baseline", lines), ("thin", "baseline_thin", few)):
            shutil.copyfile(self.folder / "beam.prm", study / f"{prm}.prm")
            (study / f"{table}.csv").write_text("".join(text))
        shutil.copyfile(SCRIPTS.parent / "convergence" / "patch_test" / "picture.png",
                        study / "picture.png")
        text = self.make(study, "--picture",
                         "thin: Element = P2-P1; Poisson ratio = 0.5; Cells = 4, 1, 1")
        page = self.sound(text)
        self.assertIn("<h1>A beam &amp; its *errors*</h1>", text)
        self.assertEqual({"study", "pictures", "charts", "runs", "parameters", "versions"}
                         - set(page.ids), set())
        self.assertEqual(text.count("<img"), 2)
        self.assertEqual(text.count('aria-label="Error of the tip"'), 2)  # the box and the chart
        self.readable(text, 10, [PHONE])

    def test_readme(self):
        images = []
        text = readme_html(README, lambda *image: images.append(image) or "<figure></figure>")
        self.assertEqual([source for _, source in images],
                         ["tip_error_against_poisson_ratio.png", "picture.png", "gone.png"])
        self.assertEqual(text.count("<figure>"), 3)
        self.assertIn("the file (<code>study.prm</code>)", text)
        self.assertIn("a site (<code>https://example.org/a?b=1&amp;c=2</code>)", text)
        self.assertIn("<h3>Deep</h3>", text)
        self.assertIn("<td><strong>38 %</strong></td>", text)
        self.assertIn("&lt;script&gt;", text)
        for gone in ("<script", "<a ", "<!--", "begin:", "its *errors*"):
            self.assertNotIn(gone, text)

    def refused(self, result, *words):
        self.assertEqual(result.returncode, 1)
        self.assertEqual(len(result.stderr.splitlines()), 1, result.stderr)
        for word in words:
            self.assertIn(word, result.stderr)
        self.assertFalse(self.file.exists())

    def test_bad_input(self):
        self.refused(self.run_script("beem"), "beem", "cantilever, ")
        self.refused(self.run_script(self.folder), "baseline")
        (self.folder / "beam.prm").write_text(STUDY.replace("final", "none"))
        results = self.run_study()
        self.refused(self.run_script(results, "--picture", "Element = P9"), "P9", "0 runs")
        self.refused(self.run_script(results, "--picture",
                                     "Element = P1; Poisson ratio = 0.3; Cells = 4, 1, 1"),
                     "solution.pvd", "VTU = final")


if __name__ == "__main__":
    unittest.main()
