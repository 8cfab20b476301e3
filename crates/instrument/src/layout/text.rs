//! The text page.

use crate::{Centre, Level, RecordingOptions};

/// What the recording is about, what is shown, how to step, and what the colours mean.
pub(crate) fn about(options: &RecordingOptions) -> String {
    let mut page = format!("# {}\n\n{}\n", options.name, options.about.trim());
    page.push_str("\n## Step through it\n\n");
    page.push_str(
        "Ctrl + Right and Ctrl + Left go one step on and back, Space plays. The time panel below \
         switches the timeline: `step`, `distance_mm` (driven), `sim_time` (1 m/s unless the config \
         says otherwise), and `event`, which counts every event of every algorithm in order. \
         Double-click a view to reset its zoom, drag to pan, Ctrl + scroll to zoom.\n",
    );
    page.push_str("\n## What is shown\n\n");
    for map in &options.maps {
        let belief = match map.centre {
            Centre::Robot => {
                "around the robot, which is all that this map claims: every volume in scope is laid \
                 out along its shortest path through the pose graph, there is no global map. \
                 Volumes that add nothing any more are retired and not drawn. Behind it or below, in tabs: \
                 the same over the true walls"
            }
            Centre::Start => {
                "in its own global frame, laid onto the true walls where the robot started. Behind \
                 it or below"
            }
        };
        page.push_str(&format!(
            "- **{}**, left: the true place, what was really seen, the true path, the true view; no \
             map and no policy ever sees this. Right: the belief, {belief}; the pose graph by \
             odometry alone over the true path. How far these two part is the drift.\n",
            map.name
        ));
    }
    if options.level == Level::Summary {
        page.push_str(
            "- At level `summary` obstacles and what was closed are drawn of the 40 nearest volumes in \
             scope, the frontier of all.\n",
        );
    }
    if options.level == Level::Full {
        page.push_str(
            "- Tab **the last event**: switch to the timeline `event` and step: thick lines draw \
             the event at hand, the log names it.\n",
        );
    }
    page.push_str("\n## Colours\n\n| colour | means |\n|---|---|\n");
    for (colour, what) in [
        ("orange, thick", "frontier: nobody knows what lies behind"),
        ("pale yellow", "frontier too short to count"),
        ("dark red", "obstacle"),
        ("green, thin", "was frontier; lies inside another volume: free"),
        ("grey, thin", "was frontier; runs along a wall that another volume saw"),
        ("purple, thin", "was frontier; could not be reached, given up"),
        ("light green cell", "really seen; stronger green: first seen at this step"),
        ("grey cell", "reachable, not seen yet"),
        ("pale blue cell", "a grid believes it free; stronger blue: since this step"),
        ("red dot, red line", "the goal; the way to it"),
        ("green to yellow dots", "candidates, from the best to the worst; grey: refused"),
        ("magenta line", "place edge of the pose graph (true view, where it outlines one)"),
        ("teal line", "the trajectory after the last correction; pale: before it"),
        (
            "black ring",
            "where the maps of one robot first disagree about a frontier, one for each cause: one sees it, \
             another believes to know what lies behind. By drift: nobody ever saw it",
        ),
        ("blue line", "path: true where it lies in the truth, odometry in the pose graph"),
    ] {
        page.push_str(&format!("| {colour} | {what} |\n"));
    }
    page
}

/// The final metrics as tables, one per map.
pub(crate) fn result(metrics: &serde_json::Value) -> String {
    let mut page = String::from("# Result\n\n");
    let plain = |value: &serde_json::Value| match value {
        serde_json::Value::Number(number) if number.is_f64() => {
            format!("{:.4}", number.as_f64().unwrap_or(f64::NAN))
        }
        other => other.to_string(),
    };
    if let Some(all) = metrics.as_object() {
        for (key, value) in all.iter().filter(|(_, value)| !value.is_object() && !value.is_array())
        {
            page.push_str(&format!("- {key}: {}\n", plain(value)));
        }
    }
    let quarrels = metrics.get("disagreements").and_then(serde_json::Value::as_array);
    for quarrel in quarrels.into_iter().flatten().filter_map(serde_json::Value::as_object) {
        page.push_str("\nWhere beliefs first disagree for this cause:\n\n");
        for (key, value) in quarrel {
            page.push_str(&format!("- {key}: {}\n", plain(value)));
        }
    }
    let Some(maps) = metrics.get("maps").and_then(serde_json::Value::as_object) else {
        return page;
    };
    page.push_str("\n| |");
    maps.keys().for_each(|name| page.push_str(&format!(" {name} |")));
    page.push_str("\n|---|");
    maps.keys().for_each(|_| page.push_str("---|"));
    let rows = maps.values().next().and_then(serde_json::Value::as_object);
    // Lists are for programs.
    let is_list = |key: &String| maps.values().any(|map| map[key.as_str()].is_array());
    for key in rows.into_iter().flat_map(|row| row.keys()).filter(|key| !is_list(key)) {
        page.push_str(&format!("\n| {key} |"));
        for map in maps.values() {
            let value = map.get(key).map_or_else(String::new, plain);
            page.push_str(&format!(" {value} |"));
        }
    }
    page.push('\n');
    page
}
