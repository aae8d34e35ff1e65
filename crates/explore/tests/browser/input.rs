//! What a hand does: clicks, touches, the wheel and keys.

use serde_json::json;

use super::Browser;

impl Browser {
    /// Clicks at the CSS pixel (`x`, `y`) of the window.
    pub fn click(&self, x: f64, y: f64) {
        self.nth_click(x, y, 1);
    }

    /// The click that is the `count`th in a row.
    fn nth_click(&self, x: f64, y: f64, count: u32) {
        for kind in ["mouseMoved", "mousePressed", "mouseReleased"] {
            let event =
                json!({ "type": kind, "x": x, "y": y, "button": "left", "clickCount": count });
            self.call("Input.dispatchMouseEvent", event);
        }
    }

    /// Drags from one CSS pixel of the window to another.
    pub fn drag(&self, from: [f64; 2], to: [f64; 2]) {
        for (kind, [x, y]) in [("mousePressed", from), ("mouseMoved", to), ("mouseReleased", to)] {
            let event = json!({
                "type": kind, "x": x, "y": y, "button": "left", "buttons": 1, "clickCount": 1,
            });
            self.call("Input.dispatchMouseEvent", event);
        }
    }

    /// Turns the wheel by `delta` pixels at the CSS pixel (`x`, `y`) of the window.
    pub fn wheel(&self, x: f64, y: f64, delta: f64) {
        let event = json!({ "type": "mouseWheel", "x": x, "y": y, "deltaX": 0, "deltaY": delta });
        self.call("Input.dispatchMouseEvent", event);
    }

    /// Clicks the middle of the element `selector`.
    pub fn click_on(&self, selector: &str) {
        self.run(&format!(
            "document.querySelector({selector:?}).scrollIntoView({{ block: 'center' }})"
        ));
        let [left, top, right, bottom] = self.edges(selector);
        self.click((left + right) / 2.0, (top + bottom) / 2.0);
    }

    /// Sets the field `selector` to `value`.
    pub fn set(&self, selector: &str, value: &str) {
        self.run(&format!(
            "for (const kind of ['input', 'change']) {{ const field = \
             document.querySelector({selector:?}); field.value = {value:?}; \
             field.dispatchEvent(new Event(kind, {{ bubbles: true }})); }}"
        ));
    }

    /// Clicks where the box shows the place `place`, a JavaScript expression.
    pub fn click_at(&self, place: &str, count: u32) {
        let [left, top, ..] = self.edges("#view");
        let at = self.run(&format!("page.view.project({place})"));
        let [x, y] = [0, 1].map(|i| at[i].as_f64().expect("it is in sight"));
        for count in 1..=count {
            self.nth_click(left + x, top + y, count);
        }
    }

    /// Touches the CSS pixel (`x`, `y`) of the window.
    pub fn tap(&self, x: f64, y: f64) {
        let points = json!([{ "x": x, "y": y }]);
        self.call(
            "Input.dispatchTouchEvent",
            json!({ "type": "touchStart", "touchPoints": points }),
        );
        self.call("Input.dispatchTouchEvent", json!({ "type": "touchEnd", "touchPoints": [] }));
    }

    /// Moves two fingers apart, or together: around the CSS pixel (`x`, `y`) of the window, from a
    /// distance of `from` pixels to one of `to`.
    pub fn pinch(&self, x: f64, y: f64, from: f64, to: f64) {
        for (kind, apart) in [("touchStart", from), ("touchMove", to)] {
            let finger =
                |id: u32, side: f64| json!({ "id": id, "x": x + side * apart / 2.0, "y": y });
            let points = json!([finger(0, -1.0), finger(1, 1.0)]);
            self.call("Input.dispatchTouchEvent", json!({ "type": kind, "touchPoints": points }));
        }
        self.call("Input.dispatchTouchEvent", json!({ "type": "touchEnd", "touchPoints": [] }));
    }

    /// Presses the key `key`, as `ArrowRight` or `n`.
    pub fn press(&self, key: &str) {
        let code = match key {
            "ArrowLeft" => 37,
            "ArrowUp" => 38,
            "ArrowRight" => 39,
            "ArrowDown" => 40,
            "Enter" => 13,
            "Tab" => 9,
            _ => key.to_uppercase().bytes().next().map_or(0, u32::from),
        };
        let mut event = json!({ "type": "keyDown", "key": key, "windowsVirtualKeyCode": code });
        match key {
            "Enter" => event["text"] = json!("\r"),
            _ if key.len() == 1 => event["text"] = json!(key),
            _ => {}
        }
        self.call("Input.dispatchKeyEvent", event);
        let event = json!({ "type": "keyUp", "key": key, "windowsVirtualKeyCode": code });
        self.call("Input.dispatchKeyEvent", event);
    }
}
