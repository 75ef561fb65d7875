#!/usr/bin/env python3
"""Drives a report page in headless Chromium and checks the rules that a page must keep.

    scripts/browser_check.py reports/latest/index.html [--shots DIRECTORY]

No console message of level error, no request beyond the page itself, sorting, filtering, anchors, downloads, readable
without JavaScript and without a style sheet, no sideways scrolling at 380 pixels, contrast of every text in light and dark.
Needs Chromium (`apt-get install chromium`; `CHROMIUM` names another binary) and nothing else: it speaks the DevTools
protocol over a pipe. Without Chromium it prints SKIPPED and ends 0. Exit code 1: a rule is broken.
"""

import argparse
import base64
import json
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

NAMES = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable", "chrome")
FLAGS = (
    "--headless=new", "--no-sandbox", "--disable-gpu", "--disable-background-networking", "--disable-component-update",
    "--disable-sync", "--disable-default-apps", "--disable-extensions", "--no-first-run", "--mute-audio", "--hide-scrollbars",
    "--remote-debugging-pipe",
)

CONTRAST = """
(() => {
  const rgb = (text) => (text.match(/[\\d.]+/g) || [0, 0, 0, 0]).map(Number);
  const linear = (c) => (c /= 255) <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4;
  const luminance = ([r, g, b]) => 0.2126 * linear(r) + 0.7152 * linear(g) + 0.0722 * linear(b);
  const ground = (element) => {
    for (let e = element; e; e = e.parentElement) {
      const colour = rgb(getComputedStyle(e).backgroundColor);
      if (colour.length < 4 || colour[3] > 0.99) return colour;
    }
    return [255, 255, 255];
  };
  const poor = new Set();
  for (const element of document.querySelectorAll("body *")) {
    const own = [...element.childNodes].some((n) => n.nodeType === 3 && n.textContent.trim());
    if (!own || ["SCRIPT", "STYLE", "TITLE"].includes(element.tagName) || element.closest("svg")) continue;
    const [a, b] = [luminance(rgb(getComputedStyle(element).color)), luminance(ground(element))];
    const ratio = (Math.max(a, b) + 0.05) / (Math.min(a, b) + 0.05);
    if (ratio < 4.5) poor.add(`${element.tagName}.${element.className} ${ratio.toFixed(2)}`);
  }
  return [...poor];
})()
"""


class Browser:
    """A Chromium that answers to the DevTools protocol over a pipe."""

    def __init__(self, binary, profile):
        to_browser, self.to = os.pipe()
        self.answers, from_browser = os.pipe()
        plumbing = f"exec 3<&{to_browser} 4>&{from_browser}; exec \"$0\" \"$@\""
        self.process = subprocess.Popen(
            ["sh", "-c", plumbing, binary, *FLAGS, f"--user-data-dir={profile}", "about:blank"],
            pass_fds=(to_browser, from_browser), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
        )
        os.close(to_browser)
        os.close(from_browser)
        self.buffer, self.number, self.events = b"", 0, []
        self.session = None
        target = self.call("Target.createTarget", url="about:blank")["targetId"]
        self.session = self.call("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
        for domain in ("Page", "Runtime", "Network", "Log"):
            self.call(f"{domain}.enable")

    def call(self, method, **params):
        self.number += 1
        number = self.number
        message = {"id": number, "method": method, "params": params}
        if self.session:
            message["sessionId"] = self.session
        os.write(self.to, json.dumps(message).encode() + b"\0")
        while True:
            answer = self.read()
            if answer.get("id") == number:
                if "error" in answer:
                    raise RuntimeError(f"{method}: {answer['error']}")
                return answer["result"]
            self.events.append(answer)

    def read(self):
        while b"\0" not in self.buffer:
            more = os.read(self.answers, 1 << 16)
            if not more:
                raise RuntimeError("Chromium closed the pipe")
            self.buffer += more
        line, self.buffer = self.buffer.split(b"\0", 1)
        return json.loads(line)

    def open(self, address):
        self.events.clear()
        self.call("Page.navigate", url=address)
        while not any(e.get("method") == "Page.loadEventFired" for e in self.events):
            self.events.append(self.read())

    def run(self, script):
        result = self.call("Runtime.evaluate", expression=script, returnByValue=True, awaitPromise=True)
        if "exceptionDetails" in result:
            raise RuntimeError(result["exceptionDetails"]["exception"].get("description", script))
        return result["result"].get("value")

    def screen(self, width, height, scheme="light"):
        self.call("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=width < 500)
        self.call("Emulation.setEmulatedMedia", features=[
            {"name": "prefers-color-scheme", "value": scheme}, {"name": "prefers-reduced-motion", "value": "reduce"}])

    def shot(self, path, whole=False):
        clip = {}
        if whole:
            size = self.call("Page.getLayoutMetrics")["cssContentSize"]
            clip = {"clip": {"x": 0, "y": 0, "width": size["width"], "height": min(size["height"], 16000), "scale": 1}}
        image = self.call("Page.captureScreenshot", format="png", captureBeyondViewport=whole, **clip)["data"]
        Path(path).write_bytes(base64.b64decode(image))

    def close(self):
        try:
            self.call("Browser.close")
        except (RuntimeError, OSError):
            pass
        try:
            self.process.wait(timeout=10)
        except subprocess.TimeoutExpired:
            self.process.kill()


class Rules:
    """Counts what was checked and what was broken."""

    def __init__(self):
        self.broken = 0

    def check(self, name, good, found=None):
        self.broken += not good
        print(f"{'ok    ' if good else 'BROKEN'} {name}" + ("" if good or found is None else f": {found}"))


def quiet(browser, rules, address, where):
    """No error on the console, no request but for the page itself and what it holds."""
    said = [e["params"]["entry"]["text"] for e in browser.events
            if e.get("method") == "Log.entryAdded" and e["params"]["entry"]["level"] == "error"]
    said += [str(e["params"]["args"]) for e in browser.events
             if e.get("method") == "Runtime.consoleAPICalled" and e["params"]["type"] == "error"]
    said += [e["params"]["exceptionDetails"]["text"] for e in browser.events if e.get("method") == "Runtime.exceptionThrown"]
    asked = [e["params"]["request"]["url"] for e in browser.events if e.get("method") == "Network.requestWillBeSent"]
    asked = [url for url in asked if url.split("#")[0] != address and not url.startswith("data:")]
    rules.check(f"no console error ({where})", not said, said)
    rules.check(f"no request ({where})", not asked, asked)


def anchors(browser, rules):
    missing = browser.run("""[...document.querySelectorAll('a[href^="#"]')].map(a => decodeURIComponent(a.hash.slice(1)))
        .filter(id => !document.getElementById(id))""")
    rules.check("every anchor leads somewhere", not missing, missing)
    twice = browser.run("(() => { const ids = [...document.querySelectorAll('[id]')].map(e => e.id);"
                        " return ids.filter((id, at) => ids.indexOf(id) !== at) })()")
    rules.check("every id is there once", not twice, twice)
    shown = browser.run("(async () => { const a = document.querySelector('.matrix td a'); a.click();"
                        " await new Promise(r => setTimeout(r, 200));"
                        " const box = document.querySelector(':target').getBoundingClientRect();"
                        " return box.top < innerHeight && box.bottom > 0 })()")
    rules.check("a cell of the matrix leads to its evidence", shown)


def sorting(browser, rules):
    column = """(() => { const t = document.querySelector('#evidence table');
        const at = [...t.tHead.rows[0].cells].findIndex(c => c.textContent.trim() === 'holds');
        t.tHead.rows[0].cells[at].querySelector('button').click();
        return [...t.tBodies[0].rows].map(r => Number(r.cells[at].dataset.v)) })()"""
    up, down = browser.run(column), browser.run(column)
    rules.check("a table sorts by numbers, up and down", up == sorted(up) and down == sorted(down, reverse=True))
    words = browser.run("""(() => { const t = document.querySelector('#evidence table');
        t.tHead.rows[0].cells[1].querySelector('button').click();
        const found = [...t.tBodies[0].rows].map(r => r.cells[1].textContent);
        const sorted = [...found].sort((a, b) => a.localeCompare(b, 'en', { numeric: true }));
        return found.length > 0 && found.every((text, at) => text === sorted[at]) })()""")
    rules.check("a table sorts by words", words)


def filtering(browser, rules):
    shown = """(() => { const input = document.querySelector('#evidence input[type=search]');
        input.value = %s; input.dispatchEvent(new Event('input'));
        return [...document.querySelectorAll('#evidence tbody tr')].filter(r => r.offsetParent).map(r => r.textContent) })()"""
    everything = browser.run(shown % "''")
    word = everything[0].split()[0].lower() if everything else ""
    some = browser.run(shown % json.dumps(word))
    none = browser.run(shown % "'no such row anywhere'")
    rules.check("a table filters", some and all(word in row.lower() for row in some) and not none)
    rules.check("an empty filter shows every row", len(browser.run(shown % "''")) == len(everything))


def downloads(browser, rules):
    bad = browser.run("""(async () => { const bad = [];
        for (const a of document.querySelectorAll('a[download]')) {
            const text = decodeURIComponent(a.href.slice(a.href.indexOf(',') + 1));
            const mesh = /\\.(off|obj)$/.test(a.download);
            if (!a.href.startsWith('data:') || !text || (mesh && !/^(OFF\\n|v )/.test(text))) bad.push(a.download);
        } return bad })()""")
    count = browser.run("document.querySelectorAll('a[download]').length")
    rules.check(f"{count} downloads are whole", not bad and count > 0, bad)


def bare(browser, rules, address):
    """Without JavaScript and without a style sheet the verdicts are there as text."""
    browser.call("Emulation.setScriptExecutionDisabled", value=True)
    browser.open(address)
    text = browser.call("DOM.getDocument", depth=-1)["root"]
    words = []

    def collect(node):
        if node.get("nodeName") in ("SCRIPT", "STYLE"):
            return
        if node.get("nodeType") == 3:
            words.append(node["nodeValue"])
        for child in node.get("children", []):
            collect(child)

    collect(text)
    said = " ".join(words)
    rules.check("verdicts are text without JavaScript", "holds" in said and " of " in said and "✓" in said)
    browser.call("Emulation.setScriptExecutionDisabled", value=False)
    browser.open(address)
    browser.run("document.querySelectorAll('style').forEach(s => s.remove())")
    verdict = browser.run("document.querySelector('.matrix td a')?.innerText.replace(/\\s+/g, ' ')")
    rules.check("verdicts are text without a style sheet", bool(verdict) and " of " in verdict or verdict == "– n/a", verdict)
    pictures = browser.run("[...document.querySelectorAll('svg path')].every(p => p.hasAttribute('fill'))")
    rules.check("pictures are painted without a style sheet", pictures)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("page", type=Path)
    parser.add_argument("--shots", type=Path, help="write screenshots into this directory")
    arguments = parser.parse_args()
    binary = os.environ.get("CHROMIUM") or next(filter(None, map(shutil.which, NAMES)), None)
    if not binary:
        print("SKIPPED: no Chromium found; install it (apt-get install chromium) or name it in CHROMIUM")
        return 0
    if not arguments.page.is_file():
        print(f"{arguments.page} is not a file; render a report first", file=sys.stderr)
        return 2
    address = arguments.page.resolve().as_uri()
    rules = Rules()
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as profile:
        browser = Browser(binary, profile)
        try:
            drive(browser, rules, address, arguments.shots)
        finally:
            browser.close()
    print(f"{rules.broken} rules broken" if rules.broken else "every rule kept")
    return 1 if rules.broken else 0


def drive(browser, rules, address, shots):
    for name, width, scheme in (("light", 1280, "light"), ("dark", 1280, "dark"), ("narrow", 380, "light")):
        browser.screen(width, 900, scheme)
        browser.open(address)
        quiet(browser, rules, address, name)
        wide = browser.run("document.documentElement.scrollWidth")
        rules.check(f"no sideways scrolling at {width} pixels ({name})", wide <= width, wide)
        poor = browser.run(CONTRAST)
        rules.check(f"contrast of at least 4.5 ({name})", not poor, poor)
        if shots:
            shots.mkdir(parents=True, exist_ok=True)
            browser.shot(shots / f"{name}.png")
            browser.shot(shots / f"{name}-whole.png", whole=True)
    browser.screen(1280, 900)
    browser.open(address)
    anchors(browser, rules)
    sorting(browser, rules)
    filtering(browser, rules)
    downloads(browser, rules)
    quiet(browser, rules, address, "after driving it")
    bare(browser, rules, address)


if __name__ == "__main__":
    sys.exit(main())
