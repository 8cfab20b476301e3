//! Views and containers as the viewer stores them.
//!
//! The SDK's own builder cannot set bounds or the background of a view, so the few components that
//! make up a layout are written here. Ids count up: the same options give the same layout.

use rerun::external::re_sdk_types::blueprint::{archetypes, components};
use rerun::{AsComponents, RecordingStream, RecordingStreamResult};

/// A view or a container that was written; its path in the layout.
#[derive(Clone)]
pub(super) struct Written(String);

/// Writes a layout, part by part.
pub(super) struct Layout<'a> {
    pub stream: &'a RecordingStream,
    pub count: u32,
}

/// A property of a view: the name of the archetype, and its components.
pub(super) type Property<'a> = (&'static str, &'a dyn AsComponents);

/// What one view shows.
pub(super) struct View<'a> {
    pub class: &'static str,
    pub name: String,
    pub origin: String,
    pub contents: Vec<String>,
    /// Properties of the view itself, such as its bounds.
    pub properties: Vec<Property<'a>>,
}

fn uuid(count: u32) -> (String, [u8; 16]) {
    let mut bytes = [0; 16];
    bytes[6] = 0x40;
    bytes[8] = 0x80;
    bytes[12..].copy_from_slice(&count.to_be_bytes());
    (format!("00000000-0000-4000-8000-0000{count:08x}"), bytes)
}

impl Layout<'_> {
    /// Writes a view.
    pub fn view(&mut self, view: &View<'_>) -> RecordingStreamResult<Written> {
        self.count += 1;
        let path = format!("view/{}", uuid(self.count).0);
        let blueprint = archetypes::ViewBlueprint::new(view.class)
            .with_display_name(view.name.as_str())
            .with_space_origin(view.origin.as_str());
        self.stream.log(path.as_str(), &blueprint)?;
        let contents = archetypes::ViewContents::new(view.contents.iter().map(String::as_str));
        self.stream.log(format!("{path}/ViewContents"), &contents)?;
        for (name, property) in &view.properties {
            self.stream.log(format!("{path}/{name}"), *property)?;
        }
        Ok(Written(path))
    }

    /// Writes a container of parts; `shares` are relative sizes, one per part, or none.
    pub fn container(
        &mut self,
        kind: components::ContainerKind,
        parts: &[Written],
        shares: &[f32],
    ) -> RecordingStreamResult<Written> {
        self.count += 1;
        let path = format!("container/{}", uuid(self.count).0);
        let contents = parts.iter().map(|part| components::IncludedContent::from(part.0.as_str()));
        let mut blueprint = archetypes::ContainerBlueprint::new(kind).with_contents(contents);
        match kind {
            components::ContainerKind::Horizontal => {
                blueprint = blueprint.with_col_shares(shares.iter().copied());
            }
            components::ContainerKind::Vertical => {
                blueprint = blueprint.with_row_shares(shares.iter().copied());
            }
            components::ContainerKind::Tabs => {
                if let Some(first) = parts.first() {
                    blueprint = blueprint.with_active_tab(first.0.as_str());
                }
            }
            components::ContainerKind::Grid => {}
        }
        self.stream.log(path.as_str(), &blueprint)?;
        Ok(Written(path))
    }

    /// Gives a container the name that its tab shows.
    pub fn named(&self, container: Written, name: &str) -> RecordingStreamResult<Written> {
        let blueprint = archetypes::ContainerBlueprint::update_fields().with_display_name(name);
        self.stream.log(container.0.as_str(), &blueprint)?;
        Ok(container)
    }

    /// Writes what is around the last container, which holds everything.
    pub fn finish(&self, timeline: &str, fps: f64, follow: bool) -> RecordingStreamResult<()> {
        let root = rerun::datatypes::Uuid { bytes: uuid(self.count).1 };
        let viewport = archetypes::ViewportBlueprint::new()
            .with_root_container(root)
            .with_auto_layout(false)
            .with_auto_views(false);
        self.stream.log("viewport", &viewport)?;
        let panel = |state| archetypes::PanelBlueprint::new().with_state(state);
        let (hidden, slim) = (components::PanelState::Hidden, components::PanelState::Collapsed);
        self.stream.log("blueprint_panel", &panel(hidden))?;
        self.stream.log("selection_panel", &panel(hidden))?;
        let time = archetypes::TimePanelBlueprint::new()
            .with_state(slim)
            .with_timeline(timeline)
            .with_fps(fps)
            .with_play_state(if follow {
                components::PlayState::Following
            } else {
                components::PlayState::Paused
            })
            .with_loop_mode(components::LoopMode::Off);
        self.stream.log("time_panel", &time)
    }
}
