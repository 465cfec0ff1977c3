// Which of the things that stand in a scene are a part of it, and which are there only to be referred to.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "scene/parameters.h"

namespace norrsken {

/// The same with the sensors that stand inside of shapes beside these, which those that measure a shape then hold.
Description with_sensors_of_shapes(Description description);

/// All nodes below the scene's own children: those that a `ref` puts there stand in the scene too.
std::set<const Node*> nodes_inside_of_others(const Node& scene);

/// These nodes and all that is inside of them, in order of appearance.
std::vector<const Node*> nodes_below(std::vector<const Node*> nodes);

/// What the picture is made of: without definitions that nothing refers to, directly or not.
std::set<const Node*> nodes_in_use(const Node& scene);

/// Takes the scene's films, media, phase functions, filters, samplers and volumes, which mean something to what refers
/// to them; warns of those that nothing does.
void take_definitions(Parameters& scene, const std::set<const Node*>& inside);

/// The scene's integrator: of several the one that none of the others refers to. Null if there is none.
const Node::Child* integrator_of_scene(Parameters& scene, const std::set<const Node*>& inside);

/// The scene's emitters, without those that are the light of shapes, of which there is a warning if no shape refers to
/// them.
std::vector<const Node*> emitters_of_scene(Parameters& scene, const std::set<const Node*>& inside);

/// The sensor with the id `choice`, or of that number, counted from 0; the first without a choice, with a warning if
/// there are others and `tell_of_others`. Null after a complaint.
const Node* choose_sensor(Parameters& scene, const std::optional<std::string>& choice, bool tell_of_others);

/// What to say to `choose_sensor` for a sensor: its number, unless that is the id of another one.
std::string word_for_sensor(const std::vector<const Node::Child*>& sensors, std::size_t number);

}  // namespace norrsken
