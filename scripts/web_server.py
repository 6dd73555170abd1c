#!/usr/bin/env python3
"""Serves a folder on 127.0.0.1 until a page of it posts what came out.

    scripts/web_server.py FOLDER PORT_FILE REPORT_FILE

The port, a free one, is written to PORT_FILE. A POST to /progress is printed; a POST to /done or /failed is written to REPORT_FILE, and ends the server.
Exit status: 0 done; 1 failed.
"""

import functools
import http.server
import sys


class Page(http.server.SimpleHTTPRequestHandler):
    state = None

    def log_message(self, *_):
        pass

    def do_POST(self):
        text = self.rfile.read(int(self.headers.get("Content-Length", 0)))
        if self.path == "/progress":
            print(text.decode(errors="replace"), flush=True)
        elif self.path in ("/done", "/failed"):
            with open(sys.argv[3], "wb") as report:
                report.write(text)
            Page.state = self.path
        self.send_response(204)
        self.end_headers()


def main():
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    handler = functools.partial(Page, directory=sys.argv[1])
    with http.server.ThreadingHTTPServer(("127.0.0.1", 0), handler) as server:
        with open(sys.argv[2], "w") as port:
            port.write(f"{server.server_port}\n")
        server.timeout = 1
        while Page.state is None:
            server.handle_request()
    sys.exit(Page.state != "/done")


main()
