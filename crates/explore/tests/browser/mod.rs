//! Headless Chromium, driven over its DevTools protocol: JSON messages on a pair of pipes.
//!
//! The crates that do this bring 80 others and a minute of compilation, most of it for a Rust type
//! for each of the protocol's messages. These tests need nine of them, and `serde_json` is here.
mod input;

use std::cell::RefCell;
use std::collections::HashMap;
use std::io::{BufRead, BufReader, Cursor, Write};
use std::path::Path;
use std::process::{ChildStdin, Command, Stdio};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::sync::{Arc, Mutex, OnceLock};
use std::time::{Duration, Instant};

use image::RgbImage;
use serde_json::{Value, json};

/// No answer takes longer, even on a busy machine.
const PATIENCE: Duration = Duration::from_secs(60);

/// The Chromium of all tests. It ends with them, when its pipes close.
struct Chromium {
    to: Mutex<ChildStdin>,
    /// Who reads the messages of each session, by its name. That of the whole browser has none.
    readers: Arc<Mutex<HashMap<String, Sender<Value>>>>,
    whole: Mutex<Session>,
    /// Windows that no test uses. To open one, and its first page, takes a second.
    free_windows: Mutex<Vec<Value>>,
}

/// One side of a conversation.
struct Session {
    name: String,
    from: Receiver<Value>,
    next_id: u64,
    /// What was told without being asked for.
    events: Vec<Value>,
}

/// A page in a window of its own.
pub struct Browser {
    chromium: &'static Chromium,
    session: RefCell<Session>,
    window: Value,
}

/// A window, with WebGL in software or with none. Nothing, with a message, where there is no
/// Chromium; where `PHOTON_MAPPING_CHROMIUM` is set there must be one.
pub fn launch(with_webgl: bool) -> Option<Browser> {
    static CHROMIUM: OnceLock<Option<Chromium>> = OnceLock::new();
    let is_expected = std::env::var_os("PHOTON_MAPPING_CHROMIUM").is_some();
    let started = CHROMIUM.get_or_init(|| {
        let found = Command::new("chromium").arg("--version").stdout(Stdio::null()).status();
        match found {
            Ok(_) => Some(Chromium::start()),
            Err(error) if is_expected => panic!("chromium cannot be run: {error}"),
            Err(error) => {
                eprintln!("SKIPPED: chromium cannot be run ({error}); no page was opened");
                None
            }
        }
    });
    let browser = started.as_ref().map(Browser::new)?;
    if !with_webgl {
        let without = "HTMLCanvasElement.prototype.getContext = () => null";
        browser.call("Page.addScriptToEvaluateOnNewDocument", json!({ "source": without }));
    }
    Some(browser)
}

impl Chromium {
    fn start() -> Self {
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
        let to = Mutex::new(child.stdin.take().expect("piped"));
        let mut messages = BufReader::new(child.stdout.take().expect("piped"));
        let readers: Arc<Mutex<HashMap<String, Sender<Value>>>> = Arc::default();
        let whole = Mutex::new(Session::new("", &readers));
        let told = Arc::clone(&readers);
        std::thread::spawn(move || {
            let mut message = Vec::new();
            while messages.read_until(0, &mut message).is_ok_and(|length| length > 0) {
                message.pop();
                let value: Value = serde_json::from_slice(&message).expect("messages are JSON");
                message.clear();
                let name = value["sessionId"].as_str().unwrap_or_default();
                if let Some(reader) = told.lock().expect("no reader panics").get(name) {
                    // A window that was closed reads no more.
                    let _ = reader.send(value);
                }
            }
        });
        Self { to, readers, whole, free_windows: Mutex::default() }
    }

    /// Calls a method of the protocol for the whole browser, and gives its result.
    fn call_whole(&self, method: &str, parameters: Value) -> Value {
        self.call(&mut self.whole.lock().expect("the browser answers"), method, parameters)
    }

    /// Calls a method of the protocol in `session`, and gives its result.
    fn call(&self, session: &mut Session, method: &str, parameters: Value) -> Value {
        let id = session.next_id;
        session.next_id += 1;
        let mut message = json!({ "id": id, "method": method, "params": parameters });
        if !session.name.is_empty() {
            message["sessionId"] = json!(session.name);
        }
        let mut to = self.to.lock().expect("no writer panics");
        write!(to, "{message}\0").and_then(|()| to.flush()).expect("the browser is running");
        drop(to);
        loop {
            let answer = session.from.recv_timeout(PATIENCE);
            let mut answer = answer.unwrap_or_else(|_| panic!("{method}: no answer"));
            if answer["id"] == id {
                assert!(answer["error"].is_null(), "{method}: {}", answer["error"]);
                return answer["result"].take();
            }
            session.events.push(answer);
        }
    }
}

impl Session {
    fn new(name: &str, readers: &Mutex<HashMap<String, Sender<Value>>>) -> Self {
        let (reader, from) = channel();
        readers.lock().expect("no reader panics").insert(name.to_owned(), reader);
        Self { name: name.to_owned(), from, next_id: 1, events: Vec::new() }
    }
}

impl Browser {
    fn new(chromium: &'static Chromium) -> Self {
        let free = chromium.free_windows.lock().expect("no window is lost").pop();
        let window = free.unwrap_or_else(|| {
            let blank = json!({ "url": "about:blank", "newWindow": true });
            chromium.call_whole("Target.createTarget", blank)["targetId"].take()
        });
        let attach = json!({ "targetId": window, "flatten": true });
        let attached = chromium.call_whole("Target.attachToTarget", attach);
        let name = attached["sessionId"].as_str().expect("a name");
        let session = RefCell::new(Session::new(name, &chromium.readers));
        let browser = Self { chromium, session, window };
        for domain in ["Page", "Runtime", "Log", "Network"] {
            browser.call(&format!("{domain}.enable"), json!({}));
        }
        // As if it were the only window.
        browser.call("Emulation.setFocusEmulationEnabled", json!({ "enabled": true }));
        browser.size(1280, 800);
        browser
    }

    /// Calls a method of the protocol and gives its result.
    pub fn call(&self, method: &str, parameters: Value) -> Value {
        self.chromium.call(&mut self.session.borrow_mut(), method, parameters)
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
        let visit = self.session.borrow().next_id;
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
        for event in &self.session.borrow().events {
            let (method, parameters) = (event["method"].as_str(), &event["params"]);
            match method {
                Some("Runtime.exceptionThrown") => panic!("{parameters}"),
                Some("Runtime.consoleAPICalled") if parameters["type"] == "error" => {
                    panic!("{parameters}")
                }
                Some("Log.entryAdded") if parameters["entry"]["level"] == "error" => {
                    panic!("{parameters}")
                }
                Some("Network.requestWillBeSent") => {
                    let url = parameters["request"]["url"].as_str().expect("an address");
                    let of_itself = ["file:", "data:", "about:"];
                    assert!(of_itself.iter().any(|kind| url.starts_with(kind)), "{url}");
                }
                _ => {}
            }
        }
    }
}

impl Drop for Browser {
    fn drop(&mut self) {
        if !std::thread::panicking() {
            self.call("Page.navigate", json!({ "url": "about:blank" }));
            // All that was set for this session ends with it.
            let session = json!({ "sessionId": self.session.borrow().name });
            self.chromium.call_whole("Target.detachFromTarget", session);
            let mut free = self.chromium.free_windows.lock().expect("no window is lost");
            free.push(self.window.take());
        }
    }
}
