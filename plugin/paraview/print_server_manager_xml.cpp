// SPDX-License-Identifier: GPL-3.0-or-later

// Prints ParaView's description of the filters: menu entries, inputs and outputs, and a property for each parameter of
// the schema.
//   print_server_manager_xml FILE

#include <algorithm>
#include <cctype>
#include <fstream>
#include <iostream>
#include <string>

#include "garmentfit/filters/filters.h"
#include "garmentfit/filters/frame_choice.h"

namespace {

using namespace garmentfit;

std::string escaped(std::string_view text)
{
    std::string made;
    for (const char c : text)
        made += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '"' ? "&quot;" : std::string(1, c);
    return made;
}

/// "contact_distance" -> "ContactDistance", the name of its setter.
std::string in_camel_case(std::string_view name)
{
    std::string made;
    bool upper = true;
    for (const char c : name) {
        if (c != '_')
            made += upper ? char(std::toupper(c)) : c;
        upper = c == '_';
    }
    return made;
}

/// "ContactDistance" -> "Contact Distance": ParaView's Python makes the first from the second.
std::string label_of(const std::string& name)
{
    std::string made;
    for (const char c : name)
        made += (std::isupper(c) && !made.empty() ? " " : "") + std::string(1, c);
    return made;
}

/// One property for each parameter.
class PrintProperty {
public:
    explicit PrintProperty(std::ostream& out) : out_(out) { }

    template <class Value>
    void operator()(const Value& value, const About& about)
    {
        if constexpr (is_optional<Value>)
            print_text(text_of(value, about), range_of<Value>(about), about);
        else
            print_number(value, about);
    }

private:
    /// An optional number is a text, because a number cannot be empty.
    void print_text(const std::string& value, const std::string& range, const About& about)
    {
        const std::string name = in_camel_case(about.name);
        out_ << "      <StringVectorProperty name=\"" << name << "\" label=\"" << label_of(name)
             << "\" command=\"SetParameter\" initial_string=\"" << about.name
             << "\" number_of_elements=\"1\" default_values=\"" << escaped(value)
             << "\" panel_visibility=\"default\">\n        <Documentation>" << escaped(about.help) << " ("
             << escaped(range) << ", or " << escaped(about.otherwise)
             << ").</Documentation>\n      </StringVectorProperty>\n";
    }

    template <class Value>
    void print_number(const Value& value, const About& about)
    {
        const char* type = std::is_same_v<Value, double> ? "DoubleVectorProperty" : "IntVectorProperty";
        const std::string name = in_camel_case(about.name);
        out_ << "      <" << type << " name=\"" << name << "\" label=\"" << label_of(name) << "\" command=\"Set" << name
             << "\" number_of_elements=\"1\" default_values=\"" << number_of(value) << "\" panel_visibility=\""
             << (about.group == Group::research ? "advanced" : "default") << "\">\n";
        print_domain(value, about);
        out_ << "        <Documentation>" << escaped(about.help) << " (" << escaped(range_of<Value>(about))
             << ").</Documentation>\n      </" << type << ">\n";
    }

    template <class Value>
    static auto number_of(const Value& value)
    {
        if constexpr (std::is_same_v<Value, double>)
            return value;
        else
            return static_cast<int>(value);
    }

    template <class Value>
    void print_domain(const Value&, const About& about)
    {
        if constexpr (std::is_enum_v<Value>) {
            out_ << "        <EnumerationDomain name=\"choices\">\n";
            for (std::size_t i = 0; i < about.choices->size(); ++i)
                out_ << "          <Entry value=\"" << i << "\" text=\"" << escaped((*about.choices)[i]) << "\"/>\n";
            out_ << "        </EnumerationDomain>\n";
        } else if constexpr (std::is_same_v<Value, bool>) {
            out_ << "        <BooleanDomain name=\"switch\"/>\n";
        } else {
            const char* type = std::is_same_v<Value, double> ? "DoubleRangeDomain" : "IntRangeDomain";
            out_ << "        <" << type << " name=\"range\" min=\"" << about.min << "\" max=\"" << about.max
                 << "\"/>\n";
        }
    }

    std::ostream& out_;
};

void print_input(std::ostream& out, const char* name, int port, const char* help, bool composite)
{
    out << "      <InputProperty name=\"" << name << "\" port_index=\"" << port
        << "\" command=\"SetInputConnection\">\n"
        << "        <ProxyGroupDomain name=\"groups\"><Group name=\"sources\"/><Group "
           "name=\"filters\"/></ProxyGroupDomain>\n"
        << "        <DataTypeDomain name=\"type\" composite_data_supported=\"" << composite
        << "\"><DataType value=\"vtkPolyData\"/>" << (composite ? "<DataType value=\"vtkCompositeDataSet\"/>" : "")
        << "</DataTypeDomain>\n"
        << "        <Documentation>" << help << "</Documentation>\n      </InputProperty>\n";
}

/// A text property with a list of values.
void print_choice(std::ostream& out, const std::string& name, const std::string& help,
                  const std::vector<std::string_view>& values)
{
    out << "      <StringVectorProperty name=\"" << name << "\" label=\"" << label_of(name) << "\" command=\"Set"
        << name << "\" number_of_elements=\"1\" default_values=\"auto\" panel_visibility=\"advanced\">\n"
        << "        <StringListDomain name=\"list\">\n";
    for (const std::string_view value : values)
        out << "          <String value=\"" << value << "\"/>\n";
    out << "        </StringListDomain>\n        <Documentation>" << help << "</Documentation>\n"
        << "      </StringVectorProperty>\n";
}

void print_choices(std::ostream& out, const Filter& filter)
{
    if (filter.has(Stage::rig)) {
        print_choice(out, "Unit", "Unit of the body.", unit_choices());
        print_choice(out, "Up", "Up axis of the body.", axis_choices());
        print_choice(out, "Front", "Axis that the chest faces.", axis_choices());
    }
    if (filter.has(Stage::fit)) {
        print_choice(out, "GarmentUnit", "Unit of the garments.", unit_choices());
        print_choice(out, "GarmentUp", "Up axis of the garments.", axis_choices());
        print_choice(out, "GarmentFront", "Axis that the garments' fronts face.", axis_choices());
    }
}

void print_outputs(std::ostream& out, bool dresses)
{
    int port = 0;
    out << "      <OutputPort index=\"" << port++ << "\" name=\"Body\" id=\"body\"/>\n";
    if (dresses)
        out << "      <OutputPort index=\"" << port++ << "\" name=\"Garments\" id=\"garments\"/>\n";
    out << "      <OutputPort index=\"" << port << "\" name=\"Skeleton\" id=\"skeleton\"/>\n";
}

void print_filter(std::ostream& out, const Filter& filter)
{
    const std::string name = in_camel_case(filter.label.substr(0, filter.label.find(' ')))
        + std::string(filter.label.substr(filter.label.find(' ') + 1));
    const bool dresses = filter.reads(Data::garments);
    out << "    <SourceProxy name=\"" << name << "\" class=\"vtk" << name << "\" label=\"" << filter.label << "\">\n"
        << "      <Documentation short_help=\"" << escaped(filter.help) << "\" long_help=\"" << escaped(filter.help)
        << "\">" << escaped(filter.help) << ".</Documentation>\n";
    print_input(out, "Body", 0, "The body; the output of the filter before, where this filter needs one.", false);
    if (dresses)
        print_input(out, "Garments", 1, "One garment, or several in a group, innermost first.", true);
    const Parameters defaults;
    describe(filter, defaults, PrintProperty(out));
    print_choices(out, filter);
    if (filter.makes(Data::recovered))
        out << "      <DoubleVectorProperty name=\"TimestepValues\" repeatable=\"1\" information_only=\"1\">\n"
               "        <TimeStepsInformationHelper/>\n      </DoubleVectorProperty>\n";
    print_outputs(out, dresses);
    out << "      <Hints><ShowInMenu category=\"Garment\"/></Hints>\n    </SourceProxy>\n";
}

}  // namespace

int main(int argc, char** argv)
{
    if (argc != 2) {
        std::cerr << "usage: print_server_manager_xml FILE\n";
        return 1;
    }
    std::ofstream out(argv[1]);
    out << "<ServerManagerConfiguration>\n  <ProxyGroup name=\"filters\">\n";
    for (const Filter& filter : filters())
        print_filter(out, filter);
    out << "  </ProxyGroup>\n</ServerManagerConfiguration>\n";
    return out.flush() ? 0 : 1;
}
