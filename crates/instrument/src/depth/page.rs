//! The text page of a recorded reduction.

/// What the recording shows, how to scrub, and what the colours mean.
pub(super) fn about(name: &str, method: &str) -> String {
    format!(
        "# {name}: {method}\n\n\
         A depth image becomes a closed, labelled polyhedron.\n\n\
         ## Scrub through it\n\n\
         The timeline `vertices` counts the vertices of the mesh: drag it from right to left to see \
         fewer and fewer. Meshes are drawn at the numbers that were asked for, and at the end. The \
         timeline `event` steps through everything in order.\n\n\
         ## Colours\n\n| faces | mean |\n|---|---|\n\
         | grey | obstacle: something stands there |\n\
         | orange | frontier: missing data, depth gaps, and the sides towards the camera |\n\n\
         ## Plots\n\n\
         Distances of the measured points from the plane of their face: root mean square and 95 %. \
         Below: what each removed vertex contributed, or how far each inserted pixel was off, \
         metres.\n"
    )
}
