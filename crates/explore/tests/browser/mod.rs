//! Headless Chromium, driven over its DevTools protocol: JSON messages on a pair of pipes.
//!
//! The crates that do this bring 80 others and a minute of compilation, most of it for a Rust type
//! for each of the protocol's messages. These tests need nine of them, and `serde_json` is here.
mod input;

use std::cell::{Cell, RefCell};
use std::io::{BufRead, BufReader, Cursor, Write};
use std::ops::Deref;
use std::path::Path;
use std::process::{ChildStdin, Command, Stdio};
use std::sync::Mutex;
use std::sync::mpsc::{Receiver, channel};
use std::time::{Duration, Instant};

use image::RgbImage;
use serde_json::{Value, json};

/// No answer takes longer, even on a busy machine.
const PATIENCE: Duration = Duration::from_secs(60);

/// Browsers that no test uses. To start one and its first page takes two seconds of a processor.
static FREE: Mutex<Vec<Browser>> = Mutex::new(Vec::new());

/// A browser with one window. It ends when its pipes close.
pub struct Browser {
    to: RefCell<ChildStdin>,
    from: Receiver<Value>,
    next_id: Cell<u64>,
    window: Value,
    session: RefCell<String>,
    /// What the page logged, and what it asked the network for.
    events: RefCell<Vec<Value>>,
}

/// A browser that is free again when this is dropped.
pub struct Borrowed(Option<Browser>);

/// A browser, with WebGL in software or with none. Nothing, with a message, where there is no
/// Chromium; where `PHOTON_MAPPING_CHROMIUM` is set there must be one.
pub fn launch(with_webgl: bool) -> Option<Borrowed> {
    let free = FREE.lock().expect("no test panics here").pop();
    let browser = free.or_else(Browser::start)?;
    browser.attach();
    if !with_webgl {
        let without = "HTMLCanvasElement.prototype.getContext = () => null";
        browser.call("Page.addScriptToEvaluateOnNewDocument", json!({ "source": without }));
    }
    Some(Borrowed(Some(browser)))
}

impl Deref for Borrowed {
    type Target = Browser;

    fn deref(&self) -> &Browser {
        self.0.as_ref().expect("it is there until this is dropped")
    }
}

impl Drop for Borrowed {
    fn drop(&mut self) {
        let browser = self.0.take().filter(|_| !std::thread::panicking());
        if let Some(browser) = browser {
            browser.detach();
            FREE.lock().expect("no test panics here").push(browser);
        }
    }
}

impl Browser {
    fn start() -> Option<Self> {
        let is_expected = std::env::var_os("PHOTON_MAPPING_CHROMIUM").is_some();
        let found = Command::new("chromium").arg("--version").stdout(Stdio::null()).status();
        if let Err(error) = found {
            assert!(!is_expected, "chromium cannot be run: {error}");
            eprintln!("SKIPPED: chromium cannot be run ({error}); no page was opened");
            return None;
        }
        // The protocol's pipes are the descriptors 3 and 4. The shell removes what Chromium leaves.
        let script = "profile=$(mktemp -d); \"$@\" \"--user-data-dir=$profile\" \
                      3<&0 4>&1 </dev/null >/dev/null 2>&1; rm -rf \"$profile\"";
        let mut child = Command::new("sh")
            .args(["-c", script, "sh", "chromium"])
            .args(["--headless", "--no-sandbox", "--disable-gpu", "--disable-quic"])
            .args(["--no-startup-window", "--no-first-run", "--disable-background-networking"])
            .args(["--disable-component-update", "--disable-sync", "--remote-debugging-pipe"])
            .args(["--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"])
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .spawn()
            .expect("a shell can be run");
        let to = RefCell::new(child.stdin.take().expect("piped"));
        let mut messages = BufReader::new(child.stdout.take().expect("piped"));
        let (sender, from) = channel();
        std::thread::spawn(move || {
            let mut message = Vec::new();
            while messages.read_until(0, &mut message).is_ok_and(|length| length > 0) {
                message.pop();
                let value = serde_json::from_slice(&message).expect("messages are JSON");
                message.clear();
                if sender.send(value).is_err() {
                    break;
                }
            }
            child.wait()
        });
        let (next_id, events) = (Cell::new(1), RefCell::default());
        let (window, session) = (Value::Null, RefCell::default());
        let mut browser = Self { to, from, next_id, window, session, events };
        let blank = json!({ "url": "about:blank" });
        browser.window = browser.call("Target.createTarget", blank)["targetId"].take();
        Some(browser)
    }

    /// Begins a session with the window.
    fn attach(&self) {
        let attach = json!({ "targetId": self.window, "flatten": true });
        let attached = self.call("Target.attachToTarget", attach);
        attached["sessionId"].as_str().expect("a name").clone_into(&mut self.session.borrow_mut());
        for domain in ["Page", "Runtime", "Log", "Network"] {
            self.call(&format!("{domain}.enable"), json!({}));
        }
        self.size(1280, 800);
    }

    /// Ends the session, and with it all that it set.
    fn detach(&self) {
        self.call("Page.navigate", json!({ "url": "about:blank" }));
        let session = self.session.take();
        self.call("Target.detachFromTarget", json!({ "sessionId": session }));
        self.events.take();
    }

    /// Calls a method of the protocol and gives its result.
    pub fn call(&self, method: &str, parameters: Value) -> Value {
        let id = self.next_id.replace(self.next_id.get() + 1);
        let mut message = json!({ "id": id, "method": method, "params": parameters });
        if !self.session.borrow().is_empty() {
            message["sessionId"] = json!(self.session);
        }
        let mut to = self.to.borrow_mut();
        write!(to, "{message}\0").and_then(|()| to.flush()).expect("the browser is running");
        loop {
            let answer = self.from.recv_timeout(PATIENCE);
            let mut answer = answer.unwrap_or_else(|_| panic!("{method}: no answer"));
            if answer["id"] == id {
                assert!(answer["error"].is_null(), "{method}: {}", answer["error"]);
                return answer["result"].take();
            }
            self.events.borrow_mut().push(answer);
        }
    }

    /// The value of the JavaScript `expression`, awaited.
    pub fn run(&self, expression: &str) -> Value {
        let parameters =
            json!({ "expression": expression, "awaitPromise": true, "returnByValue": true });
        let mut result = self.call("Runtime.evaluate", parameters);
        assert!(result["exceptionDetails"].is_null(), "{expression}: {result}");
        result["result"]["value"].take()
    }

    /// [`Self::run`], where the value is text.
    pub fn text(&self, expression: &str) -> String {
        let value = self.run(expression);
        value.as_str().unwrap_or_else(|| panic!("{expression}: {value}")).to_owned()
    }

    /// The text of the element `selector`.
    pub fn text_of(&self, selector: &str) -> String {
        self.text(&format!("document.querySelector({selector:?}).textContent"))
    }

    /// The left, top, right and bottom edge of the element `selector`, in CSS pixels of the window.
    pub fn edges(&self, selector: &str) -> [f64; 4] {
        let edges = self.run(&format!(
            "(() => {{ const r = document.querySelector({selector:?}).getBoundingClientRect(); \
             return [r.left, r.top, r.right, r.bottom]; }})()"
        ));
        [0, 1, 2, 3].map(|i| edges[i].as_f64().expect("a number"))
    }

    /// Opens `page` at `link`, and waits until it is ready and drawn.
    pub fn open(&self, page: &Path, link: &str) {
        self.load(page, link);
        self.settle();
    }

    /// Opens `page` at `link`, and waits until it is ready.
    pub fn load(&self, page: &Path, link: &str) {
        // Another link alone would not load the page again.
        let visit = self.next_id.get();
        let url = format!("file://{}?{visit}{link}", page.display());
        self.call("Page.navigate", json!({ "url": url }));
        let is_it = format!("location.search === '?{visit}'");
        self.wait_for(&format!("{is_it} && document.body?.dataset.ready === 'yes'"));
    }

    /// Waits until `condition` holds.
    pub fn wait_for(&self, condition: &str) {
        let start = Instant::now();
        while self.run(condition) != json!(true) {
            assert!(start.elapsed() < PATIENCE, "waited for {condition}");
            std::thread::sleep(Duration::from_millis(20));
        }
    }

    /// Waits until what was asked for is drawn.
    pub fn settle(&self) {
        let frame =
            "new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))";
        self.run(frame);
        // While the camera moves, a slow machine draws only some of the dots.
        self.wait_for("!window.page?.view || (page.view.part === 1 && !page.view.waiting)");
    }

    /// Makes the window `width` x `height` CSS pixels.
    pub fn size(&self, width: u32, height: u32) {
        let is_phone = width.min(height) < 500;
        let size = json!({
            "width": width, "height": height, "deviceScaleFactor": 1, "mobile": is_phone,
        });
        self.call("Emulation.setDeviceMetricsOverride", size);
        self.call("Emulation.setTouchEmulationEnabled", json!({ "enabled": is_phone }));
    }

    /// Sets the media feature `name` to `value`.
    pub fn media(&self, name: &str, value: &str) {
        let features = json!({ "features": [{ "name": name, "value": value }] });
        self.call("Emulation.setEmulatedMedia", features);
    }

    /// A picture of the window.
    pub fn screenshot(&self) -> RgbImage {
        let shot = self.call("Page.captureScreenshot", json!({ "format": "png" }));
        let png = shot["data"].as_str().expect("base64");
        let png = base64::Engine::decode(&base64::engine::general_purpose::STANDARD, png);
        let reader = Cursor::new(png.expect("base64"));
        let picture = image::load(reader, image::ImageFormat::Png).expect("a PNG picture");
        picture.into_rgb8()
    }

    /// Checks that the page has caused no error, and asked for nothing but itself.
    pub fn has_been_quiet(&self) {
        self.run("0");
        for event in self.events.borrow().iter() {
            let parameters = &event["params"];
            let url = parameters["request"]["url"].as_str().unwrap_or_default();
            let is_wrong = match event["method"].as_str() {
                Some("Runtime.exceptionThrown") => true,
                Some("Runtime.consoleAPICalled") => parameters["type"] == "error",
                Some("Log.entryAdded") => parameters["entry"]["level"] == "error",
                Some("Network.requestWillBeSent") => {
                    !["file:", "data:"].iter().any(|kind| url.starts_with(kind))
                }
                _ => false,
            };
            assert!(!is_wrong, "{event}");
        }
    }
}
