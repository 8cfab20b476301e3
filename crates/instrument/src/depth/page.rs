//! The text page of a recorded reduction.

/// What the recording shows, how to scrub, and what the colours mean.
pub(super) fn about(name: &str, methods: &[String]) -> String {
    format!(
        "# {name}: {}\n\n\
         A depth image becomes a closed, labelled polyhedron.\n\n\
         ## Scrub through it\n\n\
         The timeline `vertices` counts the vertices of the mesh: drag it from right to left to see \
         fewer and fewer, in all views at once. Meshes are drawn at the numbers that were asked for, \
         and at the end. The timeline `event` steps through everything in order.\n\n\
         ## Colours\n\n| faces | mean |\n|---|---|\n\
         | grey | obstacle: something stands there |\n\
         | orange | frontier: missing data, and depth gaps |\n\
         | orange lines | the walls of the polyhedron that lead to the camera, all frontier |\n\n\
         ## Plots\n\n\
         Distances of the measured points from the plane of their face: 95 % are nearer; and root \
         mean square. Below: what each removed vertex contributed, or how far each inserted pixel was \
         off, metres.\n",
        methods.join(", ")
    )
}
