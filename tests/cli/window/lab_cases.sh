# SPDX-License-Identifier: Apache-2.0
# Cases of window_test.sh about shaders in the lab.

# lab SHADER ARGUMENTS...
lab() {
  title=$1
  launch "$folder" luxo lab "$@"
}
write_tint() {
  cat > "$folder/tint.frag" << END
uniform float gain = 0.5;              // @slider 0 1
uniform int mode = 0;                  // @select plain|swapped
uniform vec3 tint = vec3(1.0, 0.5, 0); // @color
vec4 material(Point p) { vec3 c = gain * $1; return vec4(mode == 1 ? c.bgr : c, 1.0); }
END
}
render_tint() { (unset DISPLAY && cd "$folder" && "$bin/luxo" render tint.frag -q --size 640x360 "$@") || fail "cannot render: $*"; }

case_lab() {
  open_screen
  write_tint tint
  lab tint.frag --size 640x360
  photo given.png
  render_tint -o given_file.png
  same given.png given_file.png "the file renders headless as it is shown"

  drag_slider 0 120  # beyond its end
  await "the slider turns the uniform" logged 'a parameter is turned' 1
  at_slider 1 50 click 1
  await "the button chooses the next" logged 'a parameter is turned' 2
  photo turned.png
  render_tint -P gain=1 -P mode=swapped -o turned_file.png
  same turned.png turned_file.png "what is turned reaches the picture"
  at_slider "$save_key" 50 click 1
  await "the preset is saved" logged "saved 'preset 1' in tint.frag.presets.json" 1
  render_tint --preset 'preset 1' -o preset_file.png
  same turned.png preset_file.png "a preset has what was turned"

  # Editors save by renaming another file to this one.
  settle
  shot good
  write_tint 'p.norml'
  await "the mistake is noticed" logged "tint.frag:4:44: 'norml'" 1
  await "and shown" screen_is_not good
  photo still_good.png
  same still_good.png turned.png "the last good shader stays"
  (folder=$folder/next && mkdir "$folder" && write_tint 'p.normal')
  mv "$folder/next/tint.frag" "$folder/tint.frag"
  await "the shader is read again" logged 'shows the scene as it was saved' 1
  photo mended.png
  render_tint --preset 'preset 1' -o mended_file.png
  same mended.png mended_file.png "by the new shader, as it was turned"
  quit

  # Another file's preset, and one that was taken.
  write_tint tint
  echo '{ "presets": { "violet": { "tint": [0.5, 0, 1], "gain": 0.25, "gone": 3 } } }' > "$folder/tint.frag.presets.json"
  lab tint.frag --size 640x360
  at_slider "$next_key" 50 click 1
  await "the preset is taken" logged "took 'violet'" 1
  photo violet.png
  render_tint -P tint=0.5,0,1 -P gain=0.25 -o violet_file.png
  same violet.png violet_file.png "the values of the preset"
  quit
}

# A shader that has errors from the beginning: they are told over the scene without it, until it is mended.
case_lab_broken() {
  open_screen
  write_tint 'p.norml'
  lab tint.frag --size 640x360
  await "the mistake is told" logged "tint.frag:4:44: 'norml'" 1
  settle
  shot broken
  write_tint 'tint'
  await "it is mended" logged 'shows the scene as it was saved' 1
  await "and shown" screen_is_not broken
  photo mended.png
  render_tint -o mended_file.png
  same mended.png mended_file.png "as it was saved"
  drag_slider 0 120
  await "its uniforms have sliders" logged 'a parameter is turned' 1
  quit
}

# write_with INCLUDES...: tint.frag by renaming, as editors save.
write_with() {
  local file
  for file in "$@"; do echo "#include \"$file\""; done > "$folder/next.frag"
  echo 'vec4 material(Point p) { return vec4(more(0.5), 0.25, 0.0, 1.0); }' >> "$folder/next.frag"
  mv "$folder/next.frag" "$folder/tint.frag"
}
# What a save that has errors names is watched, too, whether it is there or not.
case_lab_includes() {
  open_screen
  write_tint tint
  lab tint.frag --size 640x360
  echo 'float more(float x) { return y; }' > "$folder/more.glsl"
  write_with more.glsl
  await "the mistake in it is told" logged "more.glsl:1:30: 'y'" 1
  echo 'float more(float x) { return x; }' > "$folder/more.glsl"
  await "it alone mends the picture" logged 'shows the scene as it was saved' 1
  write_with more.glsl gone.glsl
  await "what is not there is told" logged "tint.frag:2:10: cannot read the shader 'gone.glsl'" 1
  echo 'const float there = 1.0;' > "$folder/gone.glsl"
  await "until it is" logged 'shows the scene as it was saved' 2
  photo mended.png
  render_tint -o mended_file.png
  same mended.png mended_file.png "as it was saved"
  # Save after save, each of other files, while the ones before are compiled: the last one is not lost.
  local i
  for ((i = 1; i <= 20; ++i)); do
    cp "$folder/more.glsl" "$folder/more$i.glsl"
    write_with "more$i.glsl"
  done
  write_tint 'theLast'
  await "the last one is read" logged "tint.frag:4:42: 'theLast'" 1
  quit
}

# What turns out when it is drawn: an endless loop is told over its picture, and ends soon; a scene that cannot be drawn
# leaves the last one.
case_lab_faults() {
  open_screen
  write_tint tint
  lab tint.frag --size 320x180
  photo good.png
  write_tint 'tint*float(lightCount()); while (p.uv.x < 1e9) c += 1e-9'
  await "the loop is noticed" logged 'tint.frag: there are pixels in which the loops .* more than 32768 times' 1
  write_tint 'tint; if (p.uv.x < 1e9) return vec4(c, 0.5)'
  local through='tint.frag: in .* pixels the shader gives an opacity below 1'
  await "what is seen through is noticed" logged "$through" 1
  settle
  local told
  told=$(grep -c "^$through" "$folder/log")
  keys p
  await "no picture of it is saved" logged "$through" $((told + 1))
  write_tint tint
  await "it is mended" logged 'shows the scene as it was saved' 3
  photo mended.png
  same mended.png good.png "as it was"
  quit
}
# write_ball LIGHTS: lit by a shader, which more than 32 of them that cast shadows cannot be.
write_ball() {
  local i lights=
  for ((i = 0; i < $1; ++i)); do
    lights+=", { \"translate\": [3, 4, $i], \"light\": { \"type\": \"point\", \"shadow\": \"exact\" } }"
  done
  cat > "$folder/next.json" << END
{ "luxo": 1, "materials": { "m": { "shader": "tint.frag" } },
  "surfaces": { "ball": { "type": "sphere" }, "floor": { "type": "rectangle", "size": [9, 9] } },
  "nodes": [ { "surface": "ball", "material": "m" }, { "translate": [0, -1, 0], "surface": "floor", "material": "m" }$lights ] }
END
  mv "$folder/next.json" "$folder/ball.luxo.json"
}
case_lab_refused() {
  open_screen
  write_tint tint
  write_ball 1
  view ball.luxo.json --size 320x180
  photo good.png
  settle
  shot good
  write_ball 40
  await "it is refused" logged 'the shader of node number 1 makes one colour of all lights together' 1
  await "which is shown" screen_is_not good
  photo still_good.png
  same still_good.png good.png "the last good scene stays"
  write_ball 1
  await "it is mended" logged 'shows the scene as it was saved' 2
  photo mended.png
  same mended.png good.png "as it was"
  quit
}

# A boolean is a switch.
case_lab_switch() {
  open_screen
  cat > "$folder/tint.frag" << 'END'
uniform bool on = true;
uniform bvec3 which = bvec3(true, false, true);
vec4 material(Point p) { return vec4(on ? vec3(which) : vec3(0.5), 1.0); }
END
  lab tint.frag --size 320x180
  at_slider 0 50 mousedown 1
  at_slider 0 50 mouseup 1
  await "it is switched" logged 'a parameter is turned' 1
  photo off.png
  render_switch() { (unset DISPLAY && cd "$folder" && "$bin/luxo" render tint.frag -q --size 320x180 "$@") || fail "cannot render"; }
  render_switch -P on=false -o off_file.png
  same off.png off_file.png "it is off"
  render_switch -o on_file.png
  differ on_file.png off.png "the switch does something"
  quit
}

# What the shader gives there is 0.5, 0.25, 0; half precision has these exactly.
case_lab_probe() {
  open_screen
  write_tint tint
  lab tint.frag --size 640x360
  keys u
  xdotool mousemove --window "$window" 440 80
  await "it tells what is under the mouse" logged 'under the mouse: pixel 440,80, node ring,.* colour 0.5000 0.2500 0.0000, #bc8900' 1
  xdotool mousemove --window "$window" 600 10
  await "and that there is nothing" logged 'under the mouse: pixel 600,10, node none, colour 0.0500' 1
  quit
}

# A colour is typed after a click on it, as people write them; what is none is told, and goes on being typed.
case_lab_color() {
  open_screen
  write_tint tint
  lab tint.frag --size 640x360
  at_slider $((1048576 + 2)) 50 click 1
  types 1
  xdotool type '#40ff1'
  keys Return
  await "it is no colour" logged "'tint=#40ff1': it is of type vec3" 1
  xdotool type '0'
  keys Return
  await "it is taken" logged 'a parameter is typed' 1
  photo typed.png
  render_tint -P tint=#40ff10 -o typed_file.png
  same typed.png typed_file.png "the colour that was typed"
  at_slider $((1048576 + 2)) 50 click 1
  types 2
  xdotool type '0.25,1,0.5'
  keys Return
  await "numbers are taken, too" logged 'a parameter is typed' 2
  photo numbers.png
  render_tint -P tint=0.25,1,0.5 -o numbers_file.png
  same numbers.png numbers_file.png "the numbers that were typed"
  drag_slider 2 0  # its red
  await "a component is turned" logged 'a parameter is turned' 1
  photo turned.png
  render_tint -P tint=0,1,0.5 -o turned_file.png
  same turned.png turned_file.png "without red"
  quit
}

# Shadertoy's iMouse: y upward, z and w where the button was pressed, negative once it is not any more.
case_lab_mouse() {
  open_screen
  cat > "$folder/mouse.frag" << 'END'
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
  fragColor = vec4(step(iMouse.xy, fragCoord), fract(iMouse.z / 1024.0 + iMouse.w / 4096.0 + 0.5), 1.0);
}
END
  lab mouse.frag --size 640x360
  keys i
  render_mouse() { (unset DISPLAY && cd "$folder" && "$bin/luxo" render mouse.frag -q --size 640x360 "$@") || fail "cannot render: $*"; }
  photo idle.png
  render_mouse -o idle_file.png
  same idle.png idle_file.png "nobody has touched it"
  xdotool mousemove --window "$window" 200 100 mousedown 1
  await "one picture knows of the press" logged 'iMouse 200,259,200,259' 1
  await "and the next that it is over" logged 'iMouse 200,259,200,-259' 1
  xdotool mousemove --window "$window" 300 150
  await "it follows" logged 'iMouse 300,209,200,-259' 1
  xdotool key p  # clearing modifiers, as keys does, lets go of the mouse
  await "P saves a picture" test -s "$folder/luxo-0001.png"
  mv "$folder/luxo-0001.png" "$folder/held.png"
  render_mouse -P iMouse=300,209,200,-259 -o held_file.png
  same held.png held_file.png "it is held"
  xdotool mouseup 1
  await "it is released" logged 'iMouse 300,209,-200,-259' 1
  xdotool mousemove --window "$window" 20 30
  photo released.png
  render_mouse -P iMouse=300,209,-200,-259 -o released_file.png
  same released.png released_file.png "it is where it was"
  [[ $(grep -c '^iMouse 200,259,200,259' "$folder/log") -eq 1 ]] || fail "a press is in more than one picture"
  # A file that is saved keeps the mouse where it is.
  echo >> "$folder/mouse.frag"
  await "it is read again" logged 'shows the scene as it was saved' 1
  photo saved.png
  same saved.png released_file.png "it is where it was"
  quit
}
mouse_key=2097152
save_key=$((2147483647 - 1))
next_key=$((2147483647 - 2))

# Shader after shader takes no more than twice what the first takes. Measured with validation: 200 took it from 218 MB to
# 321, 500 to 333.
case_lab_edits() {
  open_screen
  write_tint tint
  lab tint.frag --size 320x180
  local begin i
  begin=$(megabytes)
  for ((i = 1; i <= ${LUXO_SOAK_EDITS:-500}; ++i)); do
    write_tint "tint*(0.5+sin($i.5*p.uv.x))"
    await "edit $i is shown" logged 'shows the scene as it was saved' "$i"
  done
  takes_at_most 20 "$begin"
  quit
}

case_lab_picture() {
  open_screen
  cat > "$folder/wave.frag" << 'END'
uniform float red = 0.5;  // @slider 0 1
void mainImage(out vec4 fragColor, in vec2 fragCoord) { fragColor = vec4(red, fragCoord / iResolution.xy, 1.0); }
END
  lab wave.frag --size 640x360 --time 1
  photo given.png
  (unset DISPLAY && cd "$folder" && "$bin/luxo" render wave.frag -q --size 640x360 --time 1 -o given_file.png)
  same given.png given_file.png "the file renders headless as it is shown"
  drag_slider 0 -20
  await "the slider turns the uniform" logged 'a parameter is turned' 1
  photo turned.png
  (unset DISPLAY && cd "$folder" && "$bin/luxo" render wave.frag -q --size 640x360 --time 1 -P red=0 -o turned_file.png)
  same turned.png turned_file.png "what is turned reaches the picture"
  quit
  # Nothing reads the mouse: there is nothing to take hold of but the panel.
  grep -q "^grab $mouse_key" "$folder/log" && fail "the mouse is taken, and nothing reads it"
  # A material of a scene's own.
  write_tint tint
  title=tint.frag
  launch "$folder" luxo lab tint.frag lecture --size 320x180 --time 2
  photo scene.png
  quit
}
