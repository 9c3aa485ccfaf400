"""browser.py PAGE FOLDER swiftshader|mesa: opens a page of `pages/` in headless Chromium.

The page sees FOLDER at /case/, `install`'s npm packages at /node_modules/. It ends by a POST to
/result, the bytes of FOLDER/values.f32, or to /error, a text for stderr and exit status 1."""
import http.server, os, pathlib, shutil, signal, subprocess, sys, tempfile, threading

HERE = pathlib.Path(__file__).resolve().parent
TOOLS = pathlib.Path(os.environ.get("LGP_TOOLS", HERE.parents[1] / "target/tools"))
SECONDS = 180
FLAGS = ["--headless=new", "--no-sandbox", "--disable-dev-shm-usage", "--no-first-run",
         "--ignore-gpu-blocklist", "--enable-unsafe-webgpu", "--enable-features=Vulkan",
         "--use-webgpu-adapter=swiftshader", "--enable-unsafe-swiftshader", "--use-gl=angle"]
# Mesa computes `mediump` in 16 bits, SwiftShader does not.
BACKENDS = {"swiftshader": ("--use-angle=swiftshader", {}),
            "mesa": ("--use-angle=gles-egl",
                     {"LIBGL_ALWAYS_SOFTWARE": "1", "EGL_PLATFORM": "surfaceless"})}


class Handler(http.server.SimpleHTTPRequestHandler):
    extensions_map = {".html": "text/html", ".js": "text/javascript", "": "application/octet-stream"}

    def translate_path(self, path):
        first, _, rest = path.split("?")[0].lstrip("/").partition("/")
        root = {"case": self.server.case, "node_modules": TOOLS / "node_modules"}.get(first)
        return str(root / rest if root else HERE / "pages" / first)

    def do_POST(self):
        body = self.rfile.read(int(self.headers["Content-Length"]))
        self.send_response(204)
        self.end_headers()
        if not self.server.done.is_set():
            self.server.result = (self.path, body)
            self.server.done.set()

    def log_message(self, *arguments):
        pass


def result(page, case, backend):
    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), Handler)
    server.case, server.done, server.result = pathlib.Path(case), threading.Event(), None
    threading.Thread(target=server.serve_forever, daemon=True).start()
    profile = tempfile.mkdtemp()
    flag, environment = BACKENDS[backend]
    browser = subprocess.Popen(
        [os.environ.get("CHROMIUM", "chromium"), *FLAGS, flag, f"--user-data-dir={profile}",
         f"http://127.0.0.1:{server.server_port}/{page}"],
        stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True,
        env=os.environ | environment)
    try:
        if not server.done.wait(SECONDS):
            sys.exit(f"{page}: no result in {SECONDS} s")
    finally:
        # Its helpers are of its group.
        try:
            os.killpg(browser.pid, signal.SIGKILL)
        except ProcessLookupError:
            pass
        browser.wait()
        server.shutdown()
        shutil.rmtree(profile, ignore_errors=True)
    return server.result


if __name__ == "__main__":
    page, case, backend = sys.argv[1:]
    path, body = result(page, case, backend)
    if path != "/result":
        sys.exit(f"{page}: {body.decode()}")
    pathlib.Path(case, "values.f32").write_bytes(body)
